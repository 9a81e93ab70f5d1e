//! Meshes: STL (binary and text), OBJ, and numbers in the model file.

use nalgebra::{Matrix3, Vector3};

/// The most triangles that are read.
const MOST_FACES: usize = 2_000_000;

/// Points, and triangles as triples of them.
#[derive(Debug, Default)]
pub struct Mesh {
    pub points: Vec<Vector3<f64>>,
    pub faces: Vec<[usize; 3]>,
}

/// How the volumes of pyramids between triangles and an inner point are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// With the sign of the triangle's orientation: the volume of the solid itself.
    Signed,
    /// With absolute values, as MuJoCo does by default: the same if the point is on the inner side of every triangle.
    Absolute,
}

/// The volume, its centre, and the tensor about the centre for a density of 1.
#[derive(Debug)]
pub struct Volume {
    pub volume: f64,
    pub centre: Vector3<f64>,
    pub tensor: Matrix3<f64>,
}

impl Mesh {
    /// Reads a mesh in the format of its file extension.
    ///
    /// # Errors
    /// If the mesh is invalid: what is wrong with it.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Mesh, String> {
        let ending = name.rsplit('.').next().unwrap_or_default();
        let mesh = match ending.to_ascii_lowercase().as_str() {
            "stl" => Mesh::stl(bytes),
            "obj" => Mesh::obj(bytes),
            _ => return Err("only `.stl` and `.obj` meshes are supported".to_owned()),
        }?;
        let is_fine = |face: &[usize; 3]| face.iter().all(|point| *point < mesh.points.len());
        match () {
            () if mesh.faces.is_empty() => Err("the mesh has no triangles".to_owned()),
            () if !mesh.faces.iter().all(is_fine) => {
                Err("a triangle of the mesh refers to a point that does not exist".to_owned())
            }
            () if !mesh
                .points
                .iter()
                .all(|point| point.iter().all(|x| x.is_finite())) =>
            {
                Err("a point of the mesh is not finite".to_owned())
            }
            () => Ok(mesh),
        }
    }

    /// Separate triangles, each with its own points.
    fn stl(bytes: &[u8]) -> Result<Mesh, String> {
        let cut = || "the file ends within the mesh".to_owned();
        let mut mesh = Mesh::default();
        let count = bytes.get(80..84).and_then(|count| count.try_into().ok());
        let count = count.map(|count| u32::from_le_bytes(count) as usize);
        let is_binary = count.is_some_and(|count| bytes.len() == 84 + 50 * count);
        if !is_binary && bytes.starts_with(b"solid") {
            let text =
                std::str::from_utf8(bytes).map_err(|_| "the text is not UTF-8".to_owned())?;
            for line in text
                .lines()
                .map(str::trim)
                .filter(|line| line.starts_with("vertex"))
            {
                mesh.points.push(point(line.split_whitespace().skip(1))?);
            }
            if mesh.points.len() % 3 != 0 {
                return Err(cut());
            }
        } else {
            let count = count.ok_or_else(cut)?;
            if bytes.len() < 84 + 50_usize.saturating_mul(count) {
                return Err(cut());
            }
            for triangle in bytes[84..].chunks_exact(50).take(count) {
                for corner in triangle[12..48].chunks_exact(12) {
                    let number = |i: usize| {
                        let bytes = [corner[i], corner[i + 1], corner[i + 2], corner[i + 3]];
                        f64::from(f32::from_le_bytes(bytes))
                    };
                    mesh.points
                        .push(Vector3::new(number(0), number(4), number(8)));
                }
            }
        }
        if mesh.points.len() / 3 > MOST_FACES {
            return Err(format!("the mesh has more than {MOST_FACES} triangles"));
        }
        mesh.faces = (0..mesh.points.len() / 3)
            .map(|face| [3 * face, 3 * face + 1, 3 * face + 2])
            .collect();
        Ok(mesh)
    }

    /// Points, and faces that are divided into triangles from their first point.
    fn obj(bytes: &[u8]) -> Result<Mesh, String> {
        let text = std::str::from_utf8(bytes).map_err(|_| "the text is not UTF-8".to_owned())?;
        let mut mesh = Mesh::default();
        for line in text.lines() {
            let mut words = line.split_whitespace();
            match words.next() {
                Some("v") => mesh.points.push(point(words)?),
                Some("f") => {
                    let count = mesh.points.len();
                    let corner = |word: &str| {
                        let number = word.split('/').next()?.parse::<i64>().ok()?;
                        match number {
                            1.. => usize::try_from(number - 1).ok(),
                            // A negative index counts back from the last point so far.
                            _ => count.checked_sub(usize::try_from(-number).ok()?),
                        }
                    };
                    let corners: Option<Vec<usize>> = words.map(corner).collect();
                    let corners = corners.ok_or_else(|| format!("`{line}` is not a face"))?;
                    let pairs = corners.iter().skip(1).zip(corners.iter().skip(2));
                    mesh.faces.extend(pairs.map(|(b, c)| [corners[0], *b, *c]));
                    if mesh.faces.len() > MOST_FACES {
                        return Err(format!("the mesh has more than {MOST_FACES} triangles"));
                    }
                }
                _ => {}
            }
        }
        Ok(mesh)
    }

    /// The enclosed volume; `None` if there is none.
    pub fn inside(&self, inside: Inside) -> Option<Volume> {
        let corners = |face: &[usize; 3]| face.map(|point| self.points[point]);
        let area = |[a, b, c]: [Vector3<f64>; 3]| (b - a).cross(&(c - a)).norm() / 2.0;
        let total: f64 = self.faces.iter().map(|face| area(corners(face))).sum();
        let middle: Vector3<f64> = self
            .faces
            .iter()
            .map(|face| {
                let [a, b, c] = corners(face);
                (a + b + c) / 3.0 * area([a, b, c])
            })
            .sum();
        let middle = middle / total;
        let pyramid = |top: Vector3<f64>, face: &[usize; 3]| {
            let [a, b, c] = corners(face).map(|corner| corner - top);
            let volume = a.dot(&b.cross(&c)) / 6.0;
            let volume = match inside {
                Inside::Signed => volume,
                Inside::Absolute => volume.abs(),
            };
            (volume, [a, b, c])
        };
        let mut volume = 0.0;
        let mut moment = Vector3::zeros();
        for face in &self.faces {
            let (part, [a, b, c]) = pyramid(middle, face);
            volume += part;
            moment += (a + b + c) / 4.0 * part;
        }
        let centre = middle + moment / volume;
        // The second moments of a pyramid over a triangle, with its apex at the origin.
        let mut seconds = Matrix3::zeros();
        let mut again = 0.0;
        for face in &self.faces {
            let (part, [a, b, c]) = pyramid(centre, face);
            let sum = a + b + c;
            let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
            seconds += (squares + sum * sum.transpose()) * (part / 20.0);
            again += part;
        }
        let is_solid = volume > 0.0 && again > 0.0 && again.is_finite();
        is_solid.then(|| Volume {
            volume: again,
            centre,
            tensor: Matrix3::identity() * seconds.trace() - seconds,
        })
    }
}

/// Three numbers.
fn point<'t>(mut words: impl Iterator<Item = &'t str>) -> Result<Vector3<f64>, String> {
    let mut number = || words.next().and_then(|word| word.parse::<f64>().ok());
    match (number(), number(), number()) {
        (Some(x), Some(y), Some(z)) => Ok(Vector3::new(x, y, z)),
        _ => Err("a point of the mesh lacks one of its three numbers".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 2 by 4 by 6 at (5, 0, -1), as quadrilaterals with positive and negative indices, and as STL triangles.
    #[test]
    fn a_box_of_triangles_is_a_box() {
        let corners = (0..8).map(|i| {
            let side = |bit: i32, half: f64| if i >> bit & 1 == 1 { half } else { -half };
            Vector3::new(5.0 + side(0, 1.0), side(1, 2.0), -1.0 + side(2, 3.0))
        });
        let corners: Vec<Vector3<f64>> = corners.collect();
        let mut text = String::new();
        for corner in &corners {
            text.push_str(&format!("v {} {} {}\n", corner.x, corner.y, corner.z));
        }
        text.push_str("f 1/1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf -8 -4 -2 -6\nf 2 4 8 6\n");
        let mesh = Mesh::read("box.obj", text.as_bytes()).expect("a mesh");
        let mut stl = vec![0; 80];
        stl.extend((mesh.faces.len() as u32).to_le_bytes());
        let mut words = "solid\n".to_owned();
        for face in &mesh.faces {
            stl.extend([0; 12]);
            for corner in face.map(|point| mesh.points[point]) {
                corner
                    .iter()
                    .for_each(|x| stl.extend((*x as f32).to_le_bytes()));
                words.push_str(&format!("vertex {} {} {}\n", corner.x, corner.y, corner.z));
            }
            stl.extend([0; 2]);
        }
        let binary = Mesh::read("box.STL", &stl).expect("a mesh");
        let written = Mesh::read("box.stl", words.as_bytes()).expect("a mesh");
        for mesh in [mesh, binary, written] {
            for inside in [Inside::Signed, Inside::Absolute] {
                let found = mesh.inside(inside).expect("a volume");
                assert!((found.volume - 48.0).abs() <= 1e-13, "{found:?}");
                assert!((found.centre - Vector3::new(5.0, 0.0, -1.0)).amax() <= 1e-14);
                // m/12 times sums of squares of the sides.
                let exact = Matrix3::from_diagonal(&Vector3::new(208.0, 160.0, 80.0));
                assert!((found.tensor - exact).amax() <= 1e-12, "{found:?}");
            }
        }
        for (name, bytes) in [
            ("a.obj", &b"v 1 2\n"[..]),
            ("a.obj", b"v 0 0 0\nf 1 2 3\n"),
            ("a.obj", b"v 0 0 0\nf 1 -9 1\n"),
            ("a.stl", b"solid\nvertex 1 2 3\n"),
            ("a.stl", &[0; 90]),
            ("a.stl", &[255; 90]),
            ("a.msh", b""),
        ] {
            assert!(Mesh::read(name, bytes).is_err(), "{name} {bytes:?}");
        }
    }
}
