//! The series of machines with closed contacts obey the literal equations, and wrong ones are found.

use lagrangian_mechanics::series::ProvedContactSeries;
use lagrangian_program::series::{ContactSeries, ContactState, NoSeries, Row};

use super::harness::machine;

fn of(name: &str) -> Result<ContactSeries, NoSeries> {
    let series = machine(&format!("contacts/{name}"), &[], |machine| {
        ProvedContactSeries::derive(&machine.model)
    });
    series.map(|series| (**series).clone())
}

/// Circles, points and expressions, in the plane and in space, have proved series; corners of polygons, and contacts that yield, do not.
#[test]
fn machines_with_contacts_have_proved_series() {
    for (name, contacts, with) in [
        ("bouncing_ball", 1, 1),
        ("rocking_block", 2, 2),
        ("bowling_ball", 1, 1),
        ("colliding_crusher", 2, 2),
        ("woodpecker", 3, 3),
        ("disc_over_hump", 2, 2),
        ("cue_ball", 2, 2),
        ("puck_on_slope", 2, 2),
    ] {
        let series = of(name).unwrap_or_else(|reason| panic!("{name}: {reason}"));
        let found = series.contacts.iter().flatten().count();
        assert_eq!([series.contacts.len(), found], [contacts, with], "{name}");
    }
    // The corners of the box on the floor, and not what meets the edges of the stair, whose gaps have kinks.
    let on_stair = of("box_on_stair").expect("a series").contacts;
    let (on_floor, others) = on_stair.split_at(4);
    assert!(on_floor.iter().all(Option::is_some) && others.iter().all(Option::is_none));
    // A tangent that jumps where the normal is along an axis.
    assert_eq!(of("ball_in_turning_bowl").err(), Some(NoSeries::Contacts));
}

/// Which unknowns there are follows from what contacts do, and a slip makes their matrix unsymmetric.
#[test]
fn contacts_decide_about_the_unknowns() {
    use ContactState::{Open, Slips, Sticks, SticksAlongNormal, SticksAlongTangent};
    let block = of("rocking_block").expect("a series");
    for (states, unknowns, is_symmetric) in [
        ([Open, Open], 3, true),
        ([Sticks, Open], 5, true),
        ([Open, Slips(1)], 4, false),
        ([Sticks, Slips(-1)], 6, false),
        ([Slips(1), Slips(1)], 5, false),
        ([Sticks, SticksAlongNormal], 6, true),
        ([SticksAlongTangent, Sticks], 6, true),
    ] {
        let series = block.with(&states).expect("smooth contacts");
        assert_eq!(
            (series.unknowns(), series.is_symmetric),
            (unknowns, is_symmetric)
        );
    }
    // With friction a slip has a direction.
    assert!(block.with(&[Slips(0), Open]).is_none());
}

/// Damage to the rows of a contact is found: to its residuals, to its friction, and to the sign of its forces.
#[test]
fn wrong_series_of_contacts_are_refused() {
    for name in ["rocking_block", "disc_over_hump", "woodpecker"] {
        let right = of(name).expect("a series");
        let first = right.coordinates + right.constraints;
        let mut damaged = Vec::new();
        for (k, contact) in right.contacts.iter().enumerate() {
            let contact = contact.expect("smooth contacts");
            let Some((tangent, friction)) = contact.tangent else {
                continue;
            };
            // The residuals of normal and tangent in each other's places.
            let mut one = right.clone();
            one.residuals
                .swap(contact.normal as usize, tangent as usize);
            damaged.push(one);
            // The friction of another contact, or of none: the normal force itself.
            let mut one = right.clone();
            let mut rows = one.rows.iter();
            let is_normal = |row: &Row| *row == Row::Acceleration(contact.normal);
            let normal = rows.position(is_normal).expect("its row");
            let normal = lagrangian_program::series::RowId(normal as u32);
            if normal != friction {
                one.contacts[k] =
                    right.contacts[k].map(|of| lagrangian_program::series::ContactRows {
                        tangent: Some((tangent, normal)),
                        ..of
                    });
                damaged.push(one);
            }
            // The forces along normal and tangent in each other's places.
            let mut one = right.clone();
            for row in &mut one.rows {
                match row {
                    Row::Acceleration(unknown) if *unknown == contact.normal => *unknown = tangent,
                    Row::Acceleration(unknown) if *unknown == tangent => *unknown = contact.normal,
                    _ => {}
                }
            }
            damaged.push(one);
        }
        assert!(
            first < right.residuals.len() && damaged.len() >= 2,
            "{name}"
        );
        machine(&format!("contacts/{name}"), &[], |machine| {
            assert!(ProvedContactSeries::new(right.clone(), &machine.model).is_ok());
            for series in damaged {
                let refused = ProvedContactSeries::new(series, &machine.model);
                assert_eq!(refused.err(), Some(NoSeries::Unproved), "{name}");
            }
        });
    }
}
