//! The page of a run: its contents, the things that it must not contain, and which parts of a machine are drawn as joined.

use crate::support::{Page, Scratch, floats, lagrangian, number};
use serde_json::Value;

/// The page of a library machine.
fn library(machine: &str, options: &[&str]) -> Page {
    let spec = format!("machines/{machine}.machine");
    Page::of(&spec, &with_end(options))
}

/// The page of a spec.
fn spec(text: &str, options: &[&str]) -> Page {
    let file = Scratch::new("shown.machine", text);
    Page::of(file.path(), &with_end(options))
}

/// The options with an end after one second, unless they contain one.
fn with_end<'a>(options: &[&'a str]) -> Vec<&'a str> {
    let mut options = options.to_vec();
    if !options.contains(&"--until") {
        options.extend(["--until", "1"]);
    }
    options
}

fn place(value: &Value) -> u64 {
    value
        .as_u64()
        .unwrap_or_else(|| panic!("no place: {value}"))
}

#[track_caller]
fn assert_near(value: &Value, truth: f64) {
    // Some operations on numbers near 1, each with a rounding.
    assert!(
        (number(value) - truth).abs() < 1e-14,
        "{value}, not {truth}"
    );
}

#[test]
fn a_page_needs_nothing_but_itself() {
    for machine in ["double_pendulum", "cushioned_crusher", "six_joint_arm"] {
        let html = library(machine, &[]).html;
        // XML namespaces are names, not addresses.
        let rest = html.replace("http://www.w3.org/", "");
        for outside in [
            "http://",
            "https://",
            "src=",
            "@import",
            "url(",
            "import ",
            "import(",
            "fetch(",
            "XMLHttpRequest",
            "WebSocket",
        ] {
            let found = rest
                .find(outside)
                .map(|at| &rest[at..(at + 60).min(rest.len())]);
            assert_eq!(found, None, "{machine}");
        }
        for link in html.split("href=").skip(1) {
            assert!(link.starts_with("\"#") || link.starts_with("\"data:,\""));
        }
        assert!(html.contains("default-src 'none'"));
        assert_eq!(html.matches("{{").count(), 0, "{machine}");
    }
}

#[test]
fn a_long_run_of_a_large_machine_stays_small() {
    let options = [
        "--const",
        "N=64",
        "--until",
        "60",
        "--tolerance",
        "1e-3",
        "--method",
        "dopri5",
    ];
    let page = Page::of("machines/chain.machine", &options);
    assert!(page.html.len() < 3_000_000, "{} bytes", page.html.len());
    assert_eq!((page.status, number(&page.data["to"])), (0, 60.0));
    assert_eq!(page.picture()["bodies"].as_array().map(Vec::len), Some(64));
}

#[test]
fn what_a_spec_says_cannot_leave_its_place() {
    let file = Scratch::new(
        "<b>&\"x\".machine",
        "/// </script><script>alert('docs')</script> <!-- {{data}} & \"quoted\"\n\
         machine Évil in plane {\n    parameters {\n        /// </td><img src=x onerror=alert(1)>\n        m: kg = 1\n    }\n    \
         coordinates { /** ]]> </SCRIPT> */ ψ: m = 1 }\n    bodies { ball { mass: m, at: (ψ, 0) } }\n}\n",
    );
    let page = Page::of(file.path(), &["--until", "1"]);
    assert_eq!(page.html.matches("<script").count(), 2);
    assert_eq!(page.html.matches("</script>").count(), 2);
    assert!(!page.html.contains("<img") && !page.html.contains("<b>"));
    assert!(
        page.html
            .contains("&lt;/script&gt;&lt;script&gt;alert(&#39;docs&#39;)")
    );
    assert!(page.html.contains("{{data}}"));
    assert!(page.html.contains("<code>ψ</code>"));
}

#[test]
fn every_parameter_coordinate_and_doc_is_on_the_page() {
    let page = library(
        "cushioned_crusher",
        &["--set", "omega=100", "--start", "s1=0.021"],
    );
    for name in ["omega", "drag2", "s1", "phi2", "m0", "yc"] {
        assert!(
            page.html.contains(&format!("<code>{name}</code>")),
            "{name}"
        );
    }
    for text in [
        "N·s/m",
        "kg·m²",
        "Eccentricity of the debalance.",
        "Drag of the material on the surfaces that slip along it.",
        "Dormand–Prince 8(5,3)",
        "Energy balance",
        "<code>accelerations</code>",
    ] {
        assert!(page.html.contains(text), "{text}");
    }
    let changed: Vec<&str> = page
        .html
        .split("<strong class=\"changed\">")
        .skip(1)
        .collect();
    let changed: Vec<&str> = changed
        .iter()
        .filter_map(|rest| rest.split('<').next())
        .collect();
    assert_eq!(changed, ["100", "0.021"]);
    assert!(page.html.contains("default 157.079633"));
    let page = library("prisms", &[]);
    assert!(page.html.contains("<em>On Brachistochronic Motion"));
}

#[test]
fn a_run_that_ended_early_is_shown_as_far_as_it_went() {
    let options = ["--set", "e=0", "--start", "s2=0.5", "--rate", "s2=-1"];
    let page = library("vibrating_crusher", &options);
    assert_eq!(page.status, 1);
    assert!(page.html.contains("role=\"alert\"") && page.html.contains("s2 &gt; 0"));
    let end = number(&page.data["to"]);
    assert!((end - 0.5).abs() < 1e-6, "{end}");
    for row in page.states() {
        assert!(row.iter().all(|value| value.is_finite()));
    }
}

#[test]
fn a_run_of_no_length_is_one_picture() {
    let page = Page::of("machines/double_pendulum.machine", &["--until", "0"]);
    assert_eq!(page.data["count"], 1);
    assert_eq!(page.states().len(), 1);
    assert_eq!(page.data["interval"], Value::Null);
}

#[test]
fn a_run_backward_in_time_goes_backward() {
    let page = Page::of("machines/double_pendulum.machine", &["--until", "-2"]);
    assert_eq!(number(&page.data["to"]), -2.0);
    assert!(number(&page.data["interval"]) < 0.0);
}

/// x = 6378 km + 0.1 m cos 2t, as a coordinate and as an output: 32 bits alone have steps of 0.5 m there. The tolerance is 6 mm.
#[test]
fn a_small_motion_far_from_zero_is_on_the_page() {
    let spec = "machine Far in plane {
        parameters { m: kg = 1, k: N/m = 4, at: m = 6378000 }
        coordinates { x: m = 6378000.1 }
        bodies { b { mass: m, at: (x, 0) } }
        gravity none;
        springs { s { stiffness: k, stretch: x - at } }
        outputs { far: km = x }
    }";
    let spec = Scratch::new("far.machine", spec);
    let page = Page::of(spec.path(), &["--until", "5"]);
    let base = number(&page.data["bases"][0]);
    let stored = floats(page.data["states"].as_str().expect("text"));
    for (index, state) in stored.chunks_exact(2).enumerate() {
        let x = base + f64::from(state[0]) - 6_378_000.0;
        let truth = 0.1 * (2.0 * page.time(index)).cos();
        assert!((x - truth).abs() < 0.006, "{x}, not {truth}");
    }
    let panels = page.data["panels"].as_array().expect("panels");
    let curves = panels
        .iter()
        .flat_map(|panel| panel["curves"].as_array().expect("curves"));
    let far = curves.into_iter().find(|curve| curve["name"] == "far");
    let far = far.expect("the output");
    let stored = floats(far["values"].as_str().expect("text"));
    let ends = stored
        .iter()
        .fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], x| {
            [low.min(*x), high.max(*x)]
        });
    let span = f64::from(ends[1] - ends[0]);
    assert!((span - 0.2e-3).abs() < 0.012e-3, "{span} km");
}

/// Every stored state is a row of the table of the same run, rounded to 32 bits, and the table does not depend on the page.
#[test]
fn the_states_on_the_page_are_those_of_the_table() {
    for machine in ["cart_pole", "cushioned_crusher"] {
        let table = |name: &str, report: &[&str]| {
            let csv = Scratch::new(name, "");
            let spec = format!("machines/{machine}.machine");
            let options = [
                "simulate", &spec, "--until", "0.7", "--every", "0.001", "--out",
            ];
            let output = lagrangian(&[&options, &[csv.path()][..], report].concat());
            assert!(output.status.success());
            std::fs::read_to_string(&csv.0).expect("a table")
        };
        let html = Scratch::new("table.html", "");
        let text = table("with.csv", &["--report", html.path()]);
        assert_eq!(text, table("without.csv", &[]), "{machine}");
        let page = Page::read(0, &html);
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|line| {
                line.split(',')
                    .map(|x| x.parse().expect("a number"))
                    .collect()
            })
            .collect();
        let states = page.states();
        let width = 2 * number(&page.data["coordinates"]) as usize;
        let mut compared = 0;
        for (index, state) in states.iter().enumerate() {
            let t = page.time(index);
            let row = rows.iter().find(|row| (row[0] - t).abs() < 1e-12);
            let Some(row) = row else { continue };
            compared += 1;
            let rounded: Vec<f32> = row[1..=width].iter().map(|x| *x as f32).collect();
            assert_eq!(*state, rounded, "{machine} at t = {t}");
        }
        // Both are sampled at an interval divided by powers of two, so the finer samples include the coarser.
        assert!(
            compared >= states.len().min(rows.len()) / 2,
            "{machine}: {compared}"
        );
        assert_eq!(page.time(states.len() - 1), 0.7);
    }
}

#[test]
fn curves_keep_the_extremes_of_the_run() {
    let csv = Scratch::new("extremes.csv", "");
    let options = ["--every", "0.0005", "--out", csv.path()];
    let page = library("cushioned_crusher", &options);
    let text = std::fs::read_to_string(&csv.0).expect("a table");
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let rows: Vec<Vec<f64>> = lines
        .map(|line| {
            line.split(',')
                .map(|x| x.parse().expect("a number"))
                .collect()
        })
        .collect();
    let mut seen = 0;
    for panel in page.data["panels"].as_array().expect("panels") {
        for curve in panel["curves"].as_array().expect("curves") {
            let Some(values) = curve["values"].as_str() else {
                continue;
            };
            let name = curve["name"].as_str().expect("a name");
            let column = head
                .iter()
                .position(|title| title.starts_with(name))
                .expect("in the table");
            let greatest = rows.iter().fold(f64::MIN, |m, row| m.max(row[column])) as f32;
            let least = rows.iter().fold(f64::MAX, |m, row| m.min(row[column])) as f32;
            let values = crate::support::floats(values);
            assert!(values.len() <= 1602, "{name}");
            // The page has at least as many samples, so its extremes are at least as large.
            assert!(values.iter().any(|x| *x >= greatest), "{name}");
            assert!(values.iter().any(|x| *x <= least), "{name}");
            seen += 1;
        }
    }
    // Three outputs, three energies, one residual.
    assert_eq!(seen, 7);
}

#[test]
fn a_double_pendulum_hangs_on_two_rods() {
    let page = library("double_pendulum", &[]);
    let picture = page.picture();
    assert_eq!(picture["bodies"][0]["rod"], picture["ground"]);
    assert_eq!(picture["bodies"][1]["rod"], picture["bodies"][0]["at"]);
    assert_eq!(picture["dimension"], 2);
}

/// The inertia m (2l)²/12 about the middle is that of a uniform pole of length 2l, with the hinge at one end.
#[test]
fn a_pole_is_a_bar_on_its_cart_and_the_cart_is_damped_from_the_ground() {
    let page = library("cart_pole", &[]);
    let picture = page.picture();
    let solid = &picture["bodies"][1]["solid"];
    assert_eq!(solid["form"], "bar");
    assert_eq!(solid["end"], picture["bodies"][0]["at"]);
    assert_near(&solid["half"], 0.5);
    let rail = &picture["elements"][0];
    assert_eq!(
        (&rail["placed"], &rail["damper"]),
        (&"sketch".into(), &true.into())
    );
    assert_eq!(rail["body"], 0);
    assert_near(&rail["along"][0], 1.0);
    assert_near(&rail["foot"][1], 0.0);
}

#[test]
fn the_bars_of_a_chain_reach_from_joint_to_joint() {
    for machine in ["chain", "chain_relative"] {
        let page = library(machine, &[]);
        let picture = page.picture();
        let bodies = picture["bodies"].as_array().expect("bodies");
        assert_eq!(bodies.len(), 8);
        let mut ends = Vec::new();
        for body in bodies {
            assert_eq!(body["solid"]["form"], "bar", "{machine}");
            assert_near(&body["solid"]["half"], 0.1);
            assert_eq!(body["rod"], Value::Null);
            ends.push(place(&body["solid"]["end"]));
        }
        ends.dedup();
        assert_eq!(ends.len(), 8, "{machine}: every bar has a joint of its own");
        assert_eq!(
            picture["links"],
            Value::Array(Vec::new()),
            "{machine}: bars cover their links"
        );
    }
}

#[test]
fn a_crusher_has_its_axle_its_cushions_and_its_stands() {
    let page = library("cushioned_crusher", &[]);
    let picture = page.picture();
    let bodies = picture["bodies"].as_array().expect("bodies");
    let at = |index: usize| &bodies[index]["at"];
    // Platform, debalance, mortar, pestle: the axle of the debalance is neither a body's centre nor on the ground.
    let axle = place(&bodies[1]["rod"]);
    assert!(bodies.iter().all(|body| place(&body["at"]) != axle));
    assert_ne!(axle, place(&picture["ground"]));
    for index in [0, 2, 3] {
        assert_eq!(
            bodies[index]["rod"],
            Value::Null,
            "{index} is held by springs only"
        );
    }
    // Bodies with circles are drawn by their outlines; the debalance is a disc with m R²/2 = J.
    for index in [0, 2, 3] {
        assert_eq!(bodies[index]["solid"], Value::Null);
    }
    assert_near(&bodies[1]["solid"]["radius"], (2.0 * 0.2 / 40.0_f64).sqrt());
    let circles = picture["circles"].as_array().expect("circles");
    let owners: Vec<&Value> = circles.iter().map(|circle| &circle["body"]).collect();
    assert_eq!(owners, [&Value::from(0), &2.into(), &2.into(), &3.into()]);
    let element = |name: &str, damper: bool| {
        let elements = picture["elements"].as_array().expect("elements");
        let found = elements
            .iter()
            .find(|e| e["name"] == name && e["damper"] == damper);
        found.unwrap_or_else(|| panic!("no {name}"))
    };
    for damper in [false, true] {
        let mortar = element("mortar_cushion", damper);
        assert_eq!(mortar["ends"], serde_json::json!([at(0), at(2)]));
        let pestle = element("pestle_cushion", damper);
        assert_eq!(pestle["ends"], serde_json::json!([at(2), at(3)]));
        // x − yc θ is the displacement along x of the point at y = yc; y − xc θ is that along y of the point at x = −xc.
        for (name, foot, along) in [
            ("x_left", [0.0, 0.3], [1.0, 0.0]),
            ("x_right", [0.0, -0.3], [1.0, 0.0]),
            ("y_left", [-0.4, 0.0], [0.0, 1.0]),
            ("y_right", [0.4, 0.0], [0.0, 1.0]),
        ] {
            let sketch = element(name, damper);
            assert_eq!(sketch["body"], 0);
            for k in 0..2 {
                assert_near(&sketch["foot"][k], foot[k]);
                assert_near(&sketch["along"][k], along[k]);
            }
        }
        assert_ne!(
            element("x_left", damper)["side"],
            element("x_right", damper)["side"]
        );
    }
    assert_eq!(picture["omitted"], serde_json::json!([]));
}

/// Polygons are drawn at the corners that the spec gives: in the axes of the frame, or relative to the mass centre in the body's own axes.
#[test]
fn outlines_are_drawn_where_their_corners_are() {
    let text = "machine Plates in plane {
        parameters { b: m = 3 }
        coordinates { s: m }
        frames { fixed = ground.shift(1, 2), cart = ground.shift(s, 0) }
        bodies {
            framed { mass: 1, frame: fixed, at: fixed.point(1, 1), outline: ((0, 0), (b, 0), (0, 4)) },
            free { mass: 1, at: (7, 8), angle: 0, outline: ((0, 0), (-b, 0), (0, 1)) },
            moving { mass: 1, frame: cart, outline: ((0, 0), (b, 0), (b, 1)) },
        }
    }";
    let page = spec(text, &[]);
    let picture = page.picture();
    let corners = |body: usize| -> Vec<u64> {
        let solid = &picture["bodies"][body]["solid"];
        assert_eq!(solid["form"], "outline");
        let corners = solid["corners"].as_array().expect("corners");
        corners.iter().map(place).collect()
    };
    assert_eq!(corners(0).len(), 3);
    let known = [
        (corners(0)[0], [1.0, 2.0]),
        (corners(0)[2], [1.0, 6.0]),
        (corners(1)[0], [7.0, 8.0]),
        (corners(1)[2], [7.0, 9.0]),
    ];
    for (corner, at) in known {
        for (k, value) in (0..).zip(at) {
            let set = format!("x[{}] = {value:?};", corner + k);
            assert!(page.html.contains(&set), "{set}");
        }
    }
    // The corner of a moving body at the origin of its frame is that point.
    assert_eq!(corners(2)[0], place(&picture["frames"][1]["origin"]));
    assert_eq!(corners(1)[0], place(&picture["bodies"][1]["at"]));
}

/// A uniform disc has m R²/2 = J.
#[test]
fn bodies_without_outlines_are_discs_of_their_inertia() {
    let page = library("vibrating_crusher", &[]);
    let bodies = page.picture()["bodies"].as_array().expect("bodies");
    let known = [(600.0, 60.0), (40.0, 0.2), (180.0, 9.225), (120.0, 1.536)];
    for (body, (mass, inertia)) in bodies.iter().zip(known) {
        let squared: f64 = 2.0 * inertia / mass;
        assert_eq!(body["solid"]["form"], "disc");
        assert_near(&body["solid"]["radius"], squared.sqrt());
        assert_near(&body["mass"], mass);
    }
}

/// Two discs on two bobs, with a rope of constant length between the bobs that is given by its length, by its square, or doubled.
#[test]
fn what_keeps_its_distance_by_a_constraint_is_joined_by_a_rope() {
    let rope = |said: &str| {
        let text = format!(
            "machine Roped in plane {{ parameters {{ l: m = 2 }} coordinates {{ x: m = 0, y: m = 1, u: m = 2, w: m = 1 }} \
             bodies {{ one {{ mass: 1, at: (x, y) }}, other {{ mass: 1, at: (u, w) }} }} gravity (0, -10); \
             constraints {{ rope: {said}, flat: x = 0 }} }}"
        );
        spec(&text, &[])
    };
    for said in [
        "sqrt((u - x)^2 + (w - y)^2) = l",
        "(u - x)^2 + (w - y)^2 = l^2",
        "2*l^2 = 2*(x - u)^2 + 2*(y - w)^2",
    ] {
        let page = rope(said);
        let picture = page.picture();
        let links = picture["links"].as_array().expect("links");
        assert_eq!(links.len(), 1, "{said}");
        let bodies = [0, 1].map(|body| picture["bodies"][body]["at"].clone());
        assert_eq!(links[0]["ends"], Value::from(bodies.to_vec()), "{said}");
        assert_eq!(links[0]["rope"], true);
    }
}

#[test]
fn an_arm_is_links_between_its_joints() {
    let page = library("six_joint_arm", &[]);
    let picture = page.picture();
    let links = picture["links"].as_array().expect("links");
    // Column, upper arm, forearm, hand: each starts at the end of the previous one.
    assert_eq!(links.len(), 4);
    assert_eq!(links[0]["ends"][0], picture["ground"]);
    for pair in links.windows(2) {
        assert_eq!(pair[0]["ends"][1], pair[1]["ends"][0]);
    }
    let owners: Vec<&Value> = links.iter().map(|link| &link["body"]).collect();
    assert_eq!(owners, [&Value::from(0), &1.into(), &2.into(), &4.into()]);
    assert_eq!(picture["bodies"][2]["solid"]["form"], "box");
}

/// A disc of 15 kg with C = 2A = 0.46875 kg m²: m R²/2 = C gives R = 1/4, and a thin disc has A = m R²/4.
#[test]
fn a_top_is_a_disc_on_an_axle() {
    let page = library("heavy_top", &["--until", "0.1"]);
    let body = &page.picture()["bodies"][0];
    assert_eq!(body["rod"], page.picture()["ground"]);
    assert_eq!(body["solid"]["form"], "cylinder");
    assert_near(&body["solid"]["radius"], 0.25);
    assert!(number(&body["solid"]["half"]) < 1e-7);
    assert_near(&body["solid"]["axis"][2], 1.0);
}

#[test]
fn a_pendulum_is_joined_to_the_pivot_that_drives_it() {
    let page = spec(
        "machine Kapitza in plane {\n    parameters { m: kg = 1, l: m = 1, a: m = 0.1, w: rad/s = 200, g: m/s^2 = 9.81 }\n    \
         coordinates { q: rad = 3 }\n    bodies { bob { mass: m, at: (0, a*cos(w*t)) + l*(sin(q), -cos(q)) } }\n    \
         gravity (0, -g);\n}\n",
        &[],
    );
    let picture = page.picture();
    let rod = place(&picture["bodies"][0]["rod"]);
    assert_ne!(rod, place(&picture["ground"]));
    // The pivot moves vertically by a cos ω t, and not horizontally.
    let script = &page.html;
    assert!(script.contains(&format!("x[{rod}] = 0.0;")));
}

#[test]
fn springs_stand_where_their_stretch_is_a_distance() {
    let page = spec(
        "machine Springs in plane {\n    parameters { m: kg = 1, l: m = 1, k: N/m = 50, c: N*m = 1 }\n    \
         coordinates { s: m = 0.1, q: rad = 1, x: m, u: m = 3 }\n    frames { arm = ground.turn(q) }\n    bodies {\n        \
         bob { mass: m, at: (l + s)*(sin(q), -cos(q)) },\n        cart { mass: m, at: (x + 2, 0) },\n        \
         free { mass: m, at: (u, 1) },\n    }\n    springs {\n        elastic { stiffness: k, stretch: s },\n        \
         given { stiffness: k, from: bob.at, to: cart.at, length: l },\n        nowhere { stiffness: k, stretch: s*x/l },\n    }\n    \
         torsion_springs { twist { stiffness: c, twist: q - 1 } }\n}\n",
        &["--until", "0.1"],
    );
    let picture = page.picture();
    let at = |index: usize| &picture["bodies"][index]["at"];
    let elements = picture["elements"].as_array().expect("elements");
    assert_eq!(
        elements[0]["ends"],
        serde_json::json!([picture["ground"], at(0)])
    );
    assert_eq!(elements[1]["ends"], serde_json::json!([at(0), at(1)]));
    assert_eq!(elements[2]["placed"], "twist");
    assert_eq!(elements[2]["about"], picture["ground"]);
    assert_eq!(picture["omitted"], serde_json::json!(["spring nowhere"]));
    assert!(page.html.contains("spring nowhere"));
    for index in 0..3 {
        assert_eq!(picture["bodies"][index]["rod"], Value::Null, "{index}");
    }
}

#[test]
fn circles_are_drawn_on_what_they_are_fixed_to() {
    let page = spec(
        "machine Wheel in plane {\n    parameters { m: kg = 1, J: kg*m^2 = 1, r: m = 0.3 }\n    coordinates { x: m, q: rad }\n    \
         frames { hub = ground.shift(x, 0).turn(q) }\n    bodies { wheel { mass: m, inertia: J, frame: hub } }\n    \
         circles {\n        rim { on: hub, center: (0, 0), radius: r },\n        pin { on: wheel, center: (r, 0), radius: r/9 },\n        \
         fixed { on: ground, center: (1, 2), radius: r },\n    }\n}\n",
        &[],
    );
    let picture = page.picture();
    let circles = picture["circles"].as_array().expect("circles");
    assert_eq!(circles[0]["center"], picture["bodies"][0]["at"]);
    let owners: Vec<&Value> = circles.iter().map(|circle| &circle["body"]).collect();
    assert_eq!(owners, [&Value::from(0), &Value::from(0), &Value::Null]);
    // Its circles are the outline of the body; a disc of the same inertia would be a second outline.
    assert_eq!(picture["bodies"][0]["solid"], Value::Null);
}

/// Decodes base64 of 32-bit numbers.
fn stored(value: &Value) -> Vec<f32> {
    crate::support::floats(value.as_str().expect("text"))
}

/// A ball that falls from a height h hits the floor at √(2h/g), and later after flights that shrink by e; its impulses are (1 + e) m v,
/// where v is √(2gh) and also shrinks. Each impact has a mark that leads to its instant, and an arrow.
#[test]
fn impacts_of_a_ball_are_marked_where_they_are() {
    let page = library("contacts/bouncing_ball", &["--until", "2"]);
    let (m, e, g, h) = (0.1_f64, 0.8_f64, 9.81_f64, 1.0_f64);
    let fall = (2.0 * h / g).sqrt();
    let hit = |k: i32| fall + 2.0 * fall * (1..=k).map(|i| e.powi(i)).sum::<f64>();
    let expected: Vec<f64> = (0..).map(hit).take_while(|t| *t < 2.0).collect();
    assert_eq!(expected.len(), 3);
    let marks: Vec<&str> = page
        .html
        .split("<a class=\"impact\" href=\"#t=")
        .skip(1)
        .collect();
    let times: Vec<f64> = (marks.iter())
        .map(|mark| {
            mark.split('"')
                .next()
                .and_then(|t| t.parse().ok())
                .expect("a time")
        })
        .collect();
    assert_eq!(times.len(), expected.len());
    // The tolerance of a step, 1e-9, over about twenty steps.
    for (seen, truth) in times.iter().zip(&expected) {
        assert!((seen - truth).abs() < 1e-8, "{seen}, not {truth}");
    }
    assert!(marks[0].contains("an impulse of 0.7973 N s, which took 0.3532 J"));
    let impacts = &page.data["impacts"];
    assert_eq!(stored(&impacts["contacts"]), [0.0; 3]);
    for (seen, truth) in stored(&impacts["times"]).iter().zip(&expected) {
        assert!(
            (f64::from(*seen) - truth).abs() < 1e-6,
            "{seen}, not {truth}"
        );
    }
    for (k, impulse) in stored(&impacts["impulses"]).chunks(3).enumerate() {
        let truth = (1.0 + e) * m * (2.0 * g * h).sqrt() * e.powi(k as i32);
        assert!((f64::from(impulse[0]) - truth).abs() < 1e-6 * truth);
        assert_eq!(impulse[1..], [0.0, 0.0]);
    }
    let contact = &page.picture()["contacts"][0];
    assert_eq!(contact["forces"], serde_json::json!(["normal(floor)"]));
    assert_eq!(contact["placed"], "point");
    // The force points upward, at the lowest point of the ball.
    let up = place(&contact["directions"][0]);
    for (k, value) in [(0, "0.0"), (1, "1.0")] {
        assert!(page.html.contains(&format!("x[{}] = {value};", up + k)));
    }
    assert!(page.html.contains("id=\"forces\""));
}

/// A page that shows forces has curves of all their components.
#[test]
fn every_force_of_contact_has_its_curves() {
    for (machine, directions) in [
        ("contacts/colliding_crusher", 2),
        ("contacts/dropped_box", 3),
        ("contacts/pile", 2),
        ("crushing_crusher", 2),
    ] {
        let page = library(machine, &["--until", "0.3", "--tolerance", "1e-6"]);
        let panels = page.data["panels"].as_array().expect("panels").iter();
        let curves = panels.flat_map(|panel| panel["curves"].as_array().expect("curves"));
        let names: Vec<&str> = curves
            .map(|curve| curve["name"].as_str().expect("a name"))
            .collect();
        let contacts = page.picture()["contacts"].as_array().expect("contacts");
        assert!(contacts.len() >= 2, "{machine}");
        for contact in contacts {
            let forces = contact["forces"].as_array().expect("names");
            assert_eq!(forces.len(), directions, "{machine}");
            assert_eq!(
                contact["directions"].as_array().map(Vec::len),
                Some(directions)
            );
            for force in forces {
                let name = force.as_str().expect("a name");
                assert!(names.contains(&name), "{machine}: {name}");
            }
        }
    }
}

/// A gap that is given by an expression has a line of action if it involves only one body: the walls of a box press along x.
#[test]
fn forces_of_gaps_by_expressions_are_drawn_on_their_lines() {
    let page = library("contacts/shaken_box", &[]);
    let contacts = &page.picture()["contacts"];
    for (contact, direction) in [(0, 1.0), (1, -1.0)] {
        let contact = &contacts[contact];
        assert_eq!(
            (&contact["placed"], &contact["body"]),
            (&"line".into(), &0.into())
        );
        assert_near(&contact["force"][0], direction);
        assert_near(&contact["force"][1], 0.0);
    }
    // Between two balls an expression does not determine the point of contact.
    let page = library("contacts/newtons_cradle", &[]);
    assert_eq!(page.picture()["contacts"], serde_json::json!([]));
    assert!(
        page.html
            .contains("force of contact left, force of contact right")
    );
    assert!(!page.html.contains("id=\"forces\""));
}
