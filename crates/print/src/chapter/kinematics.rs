//! Kinematics: frames of reference; positions, velocities and rotations of bodies.

use lagrangian_symbolic::{Expr, Math, print::Sign};

use super::{Chapter, Shown, code, label, listed, shown, words};
use crate::document::{Block, Words, of_docs};
use lagrangian_mechanics::angular_velocities;
use lagrangian_spec::model::{Body, Frame, Inertia, PoseChange, PoseId, Space};

impl<'d> Chapter<'_, 'd> {
    pub(super) fn kinematics(&self) -> Vec<Block> {
        let mut blocks = Vec::new();
        if !self.model.frames.is_empty() {
            blocks.push(Block::Paragraph(words![
                "Frames of reference, each by the steps from another to it:"
            ]));
            let frames = &self.model.frames;
            let item = |shown| match shown {
                Shown::Item(index) => self.frame(&frames[index]),
                Shown::Omitted(from, count) => {
                    words![format!(
                        "… and {count} more of {}, built in the same way",
                        frames[from].name.base
                    )]
                }
            };
            let items = shown(frames.iter().map(|frame| &frame.name))
                .into_iter()
                .map(item);
            blocks.push(Block::List(items.collect()));
        }
        if self.model.bodies.is_empty() {
            return blocks;
        }
        let turning = match self.model.space {
            Space::Plane => {
                "positions and velocities of mass centres along the ground's axes, and angular velocities"
            }
            Space::Space => {
                "positions and velocities of mass centres along the ground's axes, and angular velocities about each \
                 body's own axes"
            }
        };
        let exact = if self.model.approximations.is_empty() {
            ""
        } else {
            "; all of these are exact, and approximations begin with the energies"
        };
        blocks.push(Block::Paragraph(words![format!(
            "The bodies: {turning}{exact}."
        )]));
        let angular = angular_velocities(self.model);
        for shown in shown(self.model.bodies.iter().map(|body| &body.name)) {
            match shown {
                Shown::Item(index) => blocks.extend(self.body(index, &angular[index])),
                Shown::Omitted(from, count) => {
                    let base = &self.model.bodies[from].name.base;
                    let text = format!(
                        "{count} more bodies of the family {base} follow in the same way; they are left out here, and \
                         "
                    );
                    let words = words![
                        text,
                        code("derive --as program"),
                        " shows what is computed for each."
                    ];
                    blocks.push(Block::Paragraph(words));
                }
            }
        }
        blocks
    }

    /// `platform`: the ground, moved by (x, y), turned by θ.
    fn frame(&self, frame: &Frame) -> Words {
        let model = self.model;
        let mut steps: Vec<Words> = Vec::new();
        let mut pose_id = frame.pose;
        // Searches for the nearest ancestor frame that has a name and precedes this one.
        let parent = loop {
            let pose = &model.poses[pose_id.index()];
            match &pose.step {
                PoseChange::Ground => break words!["the ground"],
                PoseChange::Shift(by) => {
                    steps.push(words!["moved by ", self.tuple(by), " along its axes"])
                }
                PoseChange::Turn { angle, .. } if model.space == Space::Plane => {
                    steps.push(words!["turned by ", self.math(*angle)]);
                }
                PoseChange::Turn { axis, angle } => {
                    let axis = Math::letter(['x', 'y', 'z'][axis % 3]);
                    steps.push(words!["turned about ", axis, " by ", self.math(*angle)]);
                }
                PoseChange::Quaternion(e) => {
                    steps.push(words!["turned by the quaternion ", self.tuple(e)]);
                }
            }
            pose_id = pose.parent;
            let named = model.frames.iter().find(|other| other.pose == pose_id);
            if let Some(named) = named.filter(|_| pose_id != PoseId::GROUND) {
                break words![code(&named.name)];
            }
        };
        let mut words = words![code(&frame.name), ": "];
        words.extend(parent);
        for step in steps.into_iter().rev() {
            words.extend(words![", "]);
            words.extend(step);
        }
        if !frame.docs.is_empty() {
            words.extend(words![". "]);
            words.extend(of_docs(&frame.docs));
        }
        words
    }

    /// `(a, b)`.
    fn tuple(&self, components: &[Expr<'d>]) -> Math {
        let components = components.iter().map(|&component| self.math(component));
        Math::joined(components, Sign::Comma).in_parentheses()
    }

    fn body(&self, index: usize, angular: &[Expr<'d>]) -> Vec<Block> {
        let body = &self.model.bodies[index];
        let derived = &self.compiled.equations.bodies[index];
        let mut blocks = vec![Block::Heading(words![body.name.to_string()])];
        let mut words = self.inertia(body);
        if !body.docs.is_empty() {
            words.extend(words![" "]);
            words.extend(of_docs(&body.docs));
        }
        blocks.push(Block::Paragraph(words));
        let mut rows = Vec::new();
        for (&axis, &position) in ['x', 'y', 'z'].iter().zip(&derived.position) {
            let axis = Math::letter(axis).with_index(label(&body.name));
            rows.extend(self.equality(axis, position, ""));
        }
        for (&axis, &velocity) in ['x', 'y', 'z'].iter().zip(&derived.velocity) {
            let rate = Math::letter(axis).dotted().with_index(label(&body.name));
            rows.extend(self.equality(rate, velocity, ""));
        }
        let omega = || Math::letter('ω');
        match angular {
            [] => {}
            [about] => {
                rows.extend(self.equality(omega().with_index(label(&body.name)), *about, ""));
            }
            all => {
                for (&axis, &about) in ['x', 'y', 'z'].iter().zip(all) {
                    let index = [label(&body.name), Math::letter(axis)];
                    let omega = omega().with_index(Math::joined(index, Sign::Comma));
                    rows.extend(self.equality(omega, about, ""));
                }
            }
        }
        blocks.push(Block::Formula(rows));
        blocks
    }

    /// Mass and inertia in words.
    fn inertia(&self, body: &Body<'d>) -> Words {
        let mut words = words!["Mass ", self.math(body.mass)];
        match &body.inertia {
            Inertia::Particle => {
                words.extend(words!["; a particle, whose rotation has no energy."])
            }
            Inertia::Planar(inertia) => {
                words.extend(words![", moment of inertia ", self.math(*inertia), "."]);
            }
            Inertia::Tensor(tensor) => {
                let list = |entries: &[Expr<'d>]| {
                    listed(entries.iter().map(|&entry| words![self.math(entry)]))
                };
                words.extend(words![", moments of inertia "]);
                words.extend(list(&tensor[..3]));
                if tensor[3..].iter().any(|product| !product.is_zero()) {
                    words.extend(words![", off-diagonal entries of the tensor (xy, xz, yz) "]);
                    words.extend(list(&tensor[3..]));
                }
                words.extend(words![", about its mass centre and along its own axes."]);
            }
        }
        words
    }
}

/// Bodies whose rotation has no kinetic energy.
pub(super) fn particles<'a, 'd>(bodies: &'a [Body<'d>]) -> Vec<&'a Body<'d>> {
    let is_particle = |body: &&Body<'d>| matches!(body.inertia, Inertia::Particle);
    bodies.iter().filter(is_particle).collect()
}
