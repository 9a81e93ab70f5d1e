//! The tree of links, the joints that follow others, and the links with mass.

use std::collections::HashMap;

use super::faults::Faults;
use super::names::quoted;
use super::robot::{Joint, Link, Robot};

/// The joints of a robot as a tree.
#[derive(Debug)]
pub struct Tree {
    /// The link without a parent.
    pub root: usize,
    /// The joints, each after its parent, otherwise in the order of the file.
    pub order: Vec<usize>,
    /// The links at both ends of each joint.
    pub parent: Vec<usize>,
    pub child: Vec<usize>,
    /// The joint that each joint mimics.
    pub leader: Vec<Option<usize>>,
}

/// The index of each name; duplicates are errors.
fn index<'r>(
    names: impl Iterator<Item = (&'r str, usize)>,
    kind: &str,
    faults: &mut Faults,
) -> HashMap<&'r str, usize> {
    let mut places = HashMap::new();
    for (index, (name, at)) in names.enumerate() {
        if places.insert(name, index).is_some() {
            faults.add(at, format!("there are two {kind}s {}", quoted(name)));
        }
    }
    places
}

/// Finds the tree.
pub fn build(robot: &Robot, faults: &mut Faults) -> Option<Tree> {
    let Robot { links, joints, .. } = robot;
    let of_link = |link: &'_ Link| link.at;
    let places = index(
        links.iter().map(|link| (link.name.as_str(), of_link(link))),
        "link",
        faults,
    );
    let by_name = index(
        joints.iter().map(|joint| (joint.name.as_str(), joint.at)),
        "joint",
        faults,
    );
    let leader = leaders(joints, &by_name, faults);
    let (parent, child) = ends(joints, &places, faults)?;
    let mut below = vec![Vec::new(); links.len()];
    for (joint, upper) in parent.iter().enumerate() {
        below[*upper].push(joint);
    }
    let root = root(robot, &child, faults)?;
    let mut order = Vec::with_capacity(joints.len());
    let mut waiting: Vec<usize> = below[root].iter().rev().copied().collect();
    while let Some(joint) = waiting.pop() {
        order.push(joint);
        waiting.extend(below[child[joint]].iter().rev());
    }
    if order.len() < joints.len() && faults.is_empty() {
        let mut is_reached = vec![false; joints.len()];
        order.iter().for_each(|joint| is_reached[*joint] = true);
        for joint in (0..joints.len()).filter(|joint| !is_reached[*joint]) {
            let message = format!(
                "joint {} is part of a closed loop that is not connected to the root",
                quoted(&joints[joint].name)
            );
            faults.add(joints[joint].at, message);
        }
    }
    faults.is_empty().then_some(Tree {
        root,
        order,
        parent,
        child,
        leader,
    })
}

/// The links at both ends of each joint: parents and children.
fn ends(
    joints: &[Joint],
    places: &HashMap<&str, usize>,
    faults: &mut Faults,
) -> Option<(Vec<usize>, Vec<usize>)> {
    let mut end = |joint: &Joint, name: &str, end_name: &str| {
        let found = places.get(name).copied();
        if found.is_none() {
            let message = format!(
                "the {end_name} of joint {} is {}, but there is no such link",
                quoted(&joint.name),
                quoted(name)
            );
            faults.add(joint.at, message);
        }
        found
    };
    // All joints are looked at, so that all faults are found.
    let ends: Vec<_> = joints
        .iter()
        .map(|joint| {
            Some((
                end(joint, &joint.parent, "parent")?,
                end(joint, &joint.child, "child")?,
            ))
        })
        .collect();
    let ends = ends.into_iter().collect::<Option<Vec<_>>>()?;
    Some(ends.into_iter().unzip())
}

/// The one link without a parent, if every other link has one.
fn root(robot: &Robot, child: &[usize], faults: &mut Faults) -> Option<usize> {
    let Robot { links, joints, .. } = robot;
    let mut above = vec![None; links.len()];
    for (joint, &lower) in child.iter().enumerate() {
        if let Some(other) = above[lower].replace(joint) {
            let other: &Joint = &joints[other];
            let message = format!(
                "link {} is the child of two joints, {} and {}: URDF allows only trees",
                quoted(&links[lower].name),
                quoted(&other.name),
                quoted(&joints[joint].name)
            );
            faults.add(joints[joint].at, message);
        }
    }
    if !faults.is_empty() {
        return None;
    }
    let mut roots = (0..links.len()).filter(|link| above[*link].is_none());
    let Some(root) = roots.next() else {
        let message = if links.is_empty() {
            "the robot has no links"
        } else {
            "the links form a closed loop without a root: one link must have no parent"
        };
        faults.add(0, message);
        return None;
    };
    for other in roots {
        let message = format!(
            "links {} and {} both have no parent: a robot has one root; connect them",
            quoted(&links[root].name),
            quoted(&links[other].name)
        );
        faults.add(links[other].at, message);
    }
    Some(root)
}

/// Which joint each joint follows.
fn leaders(
    joints: &[Joint],
    by_name: &HashMap<&str, usize>,
    faults: &mut Faults,
) -> Vec<Option<usize>> {
    let mut leaders = vec![None; joints.len()];
    for (index, joint) in joints.iter().enumerate() {
        let Some(mimic) = &joint.mimic else {
            continue;
        };
        let reason = match by_name.get(mimic.joint.as_str()) {
            None => "there is no such joint".to_owned(),
            Some(leader) if joints[*leader].kind.is_single() => {
                leaders[index] = Some(*leader);
                continue;
            }
            Some(leader) => format!(
                "that is {}, which has no single value",
                joints[*leader].label
            ),
        };
        let (follower, leader) = (quoted(&joint.name), quoted(&mimic.joint));
        faults.add(
            mimic.at,
            format!("joint {follower} mimics {leader}, but {reason}"),
        );
    }
    // A path along leaders with more links than there are joints is a cycle; each joint is visited once.
    let mut is_led = vec![false; joints.len()];
    for start in 0..joints.len() {
        let mut walked = Vec::new();
        let mut at = start;
        while let (false, Some(next)) = (is_led[at], leaders[at]) {
            walked.push(at);
            if walked.len() > joints.len() {
                let mimic_at = joints[start]
                    .mimic
                    .as_ref()
                    .map_or(joints[start].at, |mimic| mimic.at);
                let name = quoted(&joints[start].name);
                faults.add(
                    mimic_at,
                    format!("joint {name} mimics others in a closed loop"),
                );
                return leaders;
            }
            at = next;
        }
        walked.iter().for_each(|joint| is_led[*joint] = true);
        is_led[at] = true;
    }
    leaders
}

impl Tree {
    /// The joint whose coordinate a joint uses, at the end of its chain of leaders.
    pub fn first_leader(&self, joint: usize) -> usize {
        let mut at = joint;
        while let Some(next) = self.leader[at] {
            at = next;
        }
        at
    }

    /// Whether each link has mass, alone or in its descendants.
    pub fn is_heavy(&self, links: &[Link]) -> Vec<bool> {
        let mut heavy: Vec<bool> = links.iter().map(|link| link.inertial.is_some()).collect();
        for &joint in self.order.iter().rev() {
            heavy[self.parent[joint]] |= heavy[self.child[joint]];
        }
        heavy
    }
}
