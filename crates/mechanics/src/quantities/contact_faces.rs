//! The distances of corners from the faces of polygons, eq. (E77).

use lagrangian_program::Role;
use lagrangian_scalar::Scalar;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::Expr;

use super::{Definition, LiterallyAt};
use crate::Equations;

/// For each corner its distance outside the face, its distance beyond the ends of the face, and the rate of the latter.
pub(super) struct ContactFaces;

impl Definition for ContactFaces {
    const ROLE: Role = Role::ContactFaces;

    fn expressions<'d>(_: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>> {
        let faces = equations.unilateral.iter().filter_map(|u| u.face);
        faces.flatten().collect()
    }

    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R> {
        let faces = at.literal.unilateral.iter().filter_map(|u| u.face);
        faces.flatten().collect()
    }
}
