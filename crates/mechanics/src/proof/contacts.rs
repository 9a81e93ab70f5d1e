//! Comparison of slips, gaps, friction and reactions with the literal equations.

use super::number::{Number, ZeroTest};
use super::{Computed, Prover, Sum, Verdict, equal, first_difference};
use crate::Disagreement;
use crate::equations::guide::{guides_of, occurs_in_equation};
use crate::equations::literal::{Lagrange, Literal, LiteralSliding, State};
use lagrangian_program::{FrictionLayout, FrictionResponse, Role, Unilateral};
use lagrangian_spec::model::Space;

impl<R: Number> Prover<'_, '_, R> {
    /// Compares the slips, and finds for each whether the program has the same sign as the literal
    /// equations; in a field it may be opposite, since a length there has no sign.
    pub(super) fn check_slips(
        &mut self,
        at: &State<R>,
        w: &[R],
        literal: &Literal<R>,
    ) -> Result<Vec<R>, Verdict> {
        // Beside unilateral contacts guides are among these.
        let are_contacts = !literal.unilateral.is_empty();
        let count = if are_contacts {
            0
        } else {
            literal.sliding.len()
        };
        let n = w.len();
        if count != self.parts.program.contacts.len() {
            return Err(self.disagreement_at(Role::Slips, 0));
        }
        if count == 0 {
            return Ok(Vec::new());
        }
        let slips = self.call(Role::Slips, at, count)?;
        let rows = self.call(Role::SlipMatrix, at, count * n)?;
        let biases = self.call(Role::SlipBias, at, count)?;
        let mut signs = Vec::with_capacity(count);
        for (k, contact) in literal.sliding.iter().enumerate() {
            let sign = if equal(slips[k], contact.slip)? {
                R::ONE
            } else if !R::IS_ORDERED {
                -R::ONE
            } else {
                return Err(self.disagreement_at(Role::Slips, k));
            };
            self.compare(Role::Slips, k, slips[k], sign * contact.slip)?;
            let row = &rows[k * n..][..n];
            let along = Sum::products(row, w).plus(-(sign * contact.slip_along));
            if !along.vanishes()? {
                let entry = |j: usize| (row[j], sign * self.literal(at, j).sliding[k].slip_along);
                let j = first_difference(n, entry);
                return Err(self.disagreement_at(Role::SlipMatrix, k * n + j));
            }
            let rate = Sum::products(row, &at.a).plus(biases[k]);
            self.compare_difference(Role::SlipBias, k, rate.plus(-(sign * contact.slip_rate)))?;
            signs.push(sign);
        }
        Ok(signs)
    }

    /// Compares the unilateral contacts: gaps; the rates, rows and biases of both directions, each
    /// like those of a constraint that would hold the contact; and the coefficients.
    pub(super) fn check_unilateral(
        &mut self,
        at: &State<R>,
        w: &[R],
        literal: &Literal<R>,
    ) -> Result<(), Verdict> {
        let is_guide = |one: &&Unilateral| one.is_guide;
        let guides = self
            .parts
            .program
            .unilateral
            .iter()
            .filter(is_guide)
            .count();
        let (n, count) = (w.len(), literal.unilateral.len() + guides);
        if count != self.parts.program.unilateral.len() {
            return Err(self.disagreement_at(Role::Gaps, 0));
        }
        if count == 0 {
            return Ok(());
        }
        let gaps = self.call(Role::Gaps, at, count)?;
        let rates = self.call(Role::ContactRates, at, 2 * count)?;
        let rows = self.call(Role::ContactMatrix, at, 2 * count * n)?;
        let biases = self.call(Role::ContactBias, at, 2 * count)?;
        let coefficients = self.call(Role::ContactCoefficients, at, 4 * count)?;
        let faces = literal.unilateral.iter().filter(|one| one.face.is_some());
        if self.parts.program.sizes().faces != faces.count() {
            return Err(self.disagreement_at(Role::ContactFaces, 0));
        }
        for (k, contact) in literal.unilateral.iter().enumerate() {
            self.compare(Role::Gaps, k, gaps[k], contact.opening.position)?;
            // Positions must not depend on rates.
            self.compare(Role::Gaps, k, contact.opening.by_rates, R::ZERO)?;
            self.compare(Role::Gaps, k, contact.gap.by_rates, R::ZERO)?;
            for (i, direction) in [contact.gap, contact.slip].into_iter().enumerate() {
                let i = 2 * k + i;
                self.compare(Role::ContactRates, i, rates[i], direction.rate)?;
                let row = &rows[i * n..][..n];
                let along = Sum::products(row, w).plus(-direction.along);
                self.compare_difference(Role::ContactMatrix, i * n, along)?;
                let rate = Sum::products(row, &at.a).plus(biases[i]);
                self.compare_difference(Role::ContactBias, i, rate.plus(-direction.acceleration))?;
            }
            for (i, &expected) in contact.coefficients.iter().enumerate() {
                let i = 4 * k + i;
                self.compare(Role::ContactCoefficients, i, coefficients[i], expected)?;
            }
        }
        if guides == 0 {
            return Ok(());
        }
        let numbers = ContactNumbers {
            gaps: &gaps,
            rates: &rates,
            rows: &rows,
            biases: &biases,
            coefficients: &coefficients,
        };
        let signs = self.check_guides_beside_contacts(at, w, literal, &numbers)?;
        self.check_reactions_beside_contacts(at, literal.unilateral.len(), &signs)
    }

    /// Compares guides that are among the unilateral contacts: their gaps and normals are 0, and their slips are those of guides. Returns what
    /// [`check_slips`](Self::check_slips) returns.
    fn check_guides_beside_contacts(
        &mut self,
        at: &State<R>,
        w: &[R],
        literal: &Literal<R>,
        numbers: &ContactNumbers<'_, R>,
    ) -> Result<Vec<R>, Verdict> {
        let (n, first) = (w.len(), literal.unilateral.len());
        let mut signs = Vec::with_capacity(literal.sliding.len());
        if numbers.gaps.len() != first + literal.sliding.len() {
            return Err(self.disagreement_at(Role::Gaps, first));
        }
        for (guide, contact) in literal.sliding.iter().enumerate() {
            let k = first + guide;
            let (normal, tangent) = (2 * k, 2 * k + 1);
            self.compare(Role::Gaps, k, numbers.gaps[k], R::ZERO)?;
            self.compare(Role::ContactRates, normal, numbers.rates[normal], R::ZERO)?;
            self.compare(Role::ContactBias, normal, numbers.biases[normal], R::ZERO)?;
            for (j, entry) in numbers.rows[normal * n..][..n].iter().enumerate() {
                self.compare(Role::ContactMatrix, normal * n + j, *entry, R::ZERO)?;
            }
            let slip = numbers.rates[tangent];
            let sign = if equal(slip, contact.slip)? {
                R::ONE
            } else if !R::IS_ORDERED {
                -R::ONE
            } else {
                return Err(self.disagreement_at(Role::ContactRates, tangent));
            };
            self.compare(Role::ContactRates, tangent, slip, sign * contact.slip)?;
            let row = &numbers.rows[tangent * n..][..n];
            let along = Sum::products(row, w).plus(-(sign * contact.slip_along));
            self.compare_difference(Role::ContactMatrix, tangent * n, along)?;
            let rate = Sum::products(row, &at.a).plus(numbers.biases[tangent]);
            let rate = rate.plus(-(sign * contact.slip_rate));
            self.compare_difference(Role::ContactBias, tangent, rate)?;
            let [friction, static_friction] = contact.coefficients;
            let expected = [R::ZERO, R::ZERO, friction, static_friction];
            for (i, expected) in expected.into_iter().enumerate() {
                let i = 4 * k + i;
                self.compare(
                    Role::ContactCoefficients,
                    i,
                    numbers.coefficients[i],
                    expected,
                )?;
            }
            signs.push(sign);
        }
        Ok(signs)
    }

    /// Checks that the normal reactions of guides that are among the unilateral contacts balance the forces that would open the guides, whatever the
    /// accelerations, the multipliers and the forces of contacts are. In a field the sides of guides are unknown; every machine with guides is
    /// also proved in numbers that have an order.
    fn check_reactions_beside_contacts(
        &mut self,
        at: &State<R>,
        first: usize,
        signs: &[R],
    ) -> Result<(), Verdict> {
        let (n, m) = (at.q.len(), self.parts.program.constraints.len());
        let (contacts, count) = (first + signs.len(), signs.len());
        let width = n + m + 2 * contacts;
        let matrix = self.call(Role::GuideMatrix, at, count * width)?;
        let loads = self.call(Role::GuideLoads, at, count)?;
        if !R::IS_ORDERED {
            return Ok(());
        }
        let Some(relaxed) = self.parts.relaxed else {
            return Err(Verdict::Undefined);
        };
        let acting: Vec<R> = (at.a.iter().copied())
            .chain(self.random_numbers(3, m + 2 * contacts))
            .collect();
        let (multipliers, forces) = acting[n..].split_at(m);
        let normals: Vec<R> = (matrix.chunks_exact(width).zip(&loads))
            .map(|(row, load)| Sum::products(row, &acting).plus(*load).value)
            .collect();
        let literal = self.parts.machine.at(at, &vec![R::ZERO; n]).sliding;
        let guides = guides_of(relaxed.model);
        let sides: Vec<R> = literal.iter().map(|contact| contact.side.sign()).collect();
        if !sides.iter().all(|side| side.is_finite()) {
            return Err(Verdict::Undefined);
        }
        for (k, opening) in openings(relaxed, at, &literal, (&guides, &sides)) {
            let mut open = Sum::of([opening.inertia, -opening.applied]);
            for (constraint, &multiplier) in opening.constraints.iter().zip(multipliers) {
                open = open.plus(-(constraint.along * multiplier));
            }
            for (contact, forces) in opening.unilateral.iter().zip(forces.chunks_exact(2)) {
                open = open.plus(-(contact.gap.along * forces[0]));
                open = open.plus(-(contact.slip.along * forces[1]));
            }
            for (j, contact) in opening.sliding.iter().enumerate() {
                let friction = signs[j] * forces[2 * (first + j) + 1];
                open = open.plus(-(contact.slip_along * friction));
                for &off in &contact.off_along {
                    open = open.plus(-(sides[j] * off * normals[j]));
                }
            }
            if !open.value.is_finite() {
                return Err(Verdict::Undefined);
            }
            if !open.vanishes()? {
                return Err(self.disagreement_at(Role::GuideLoads, k));
            }
        }
        Ok(())
    }

    /// Checks that for any friction forces the accelerations, multipliers and normal reactions obey the
    /// equations of motion, of the constraints, and of the displacements that would open the guides.
    pub(super) fn check_friction(
        &mut self,
        at: &State<R>,
        computed: &Computed<R>,
        signs: &[R],
    ) -> Result<(), Verdict> {
        let (n, count) = (at.q.len(), signs.len());
        let layout = FrictionLayout {
            coordinates: n,
            constraints: self.parts.program.constraints.len(),
            contacts: count,
            axes: self.parts.program.reaction_axes,
        };
        let values = self.call(Role::Friction, at, layout.len())?;
        let response = FrictionResponse {
            layout,
            values: &values,
        };
        let friction_forces = self.random_numbers(2, count);
        let total = |place: usize| response.with(place, &friction_forces);
        let total: Vec<R> = (0..layout.part()).map(total).collect();
        let total = layout.split(&total);
        let rows = self.call(Role::SlipMatrix, at, count * n)?;
        let biases = self.call(Role::SlipBias, at, count)?;
        let mut forces = computed.forces.clone();
        for (row, &friction) in rows.chunks(n).zip(&friction_forces) {
            for (force, &tau) in forces.iter_mut().zip(row) {
                *force = *force + tau * friction;
            }
        }
        let (a, multipliers) = (total.accelerations, total.multipliers);
        self.check_balance(computed, a, multipliers, &forces)?;
        for (k, row) in rows.chunks(n).enumerate() {
            let rate = Sum::products(row, a).plus(biases[k]);
            let rate = rate.plus(-total.slip_rates[k]);
            self.compare_difference(Role::Friction, layout.slip_rate(k), rate)?;
        }

        let moving = State {
            a: a.to_vec(),
            ..at.clone()
        };
        let contacts = self.parts.machine.at(&moving, &vec![R::ZERO; n]).sliding;
        self.check_guides(response, &contacts)?;
        let pressed = GuideForces {
            multipliers,
            friction_forces: &friction_forces,
            normals: total.normals,
            axes: layout.axes,
            signs,
        };
        self.check_reactions(&moving, &contacts, &pressed)
    }

    /// Checks the coefficients of friction of the guides, and in space their directions.
    fn check_guides(
        &mut self,
        response: FrictionResponse<'_, R>,
        contacts: &[LiteralSliding<R>],
    ) -> Result<(), Verdict> {
        let layout = response.layout;
        for (k, contact) in contacts.iter().enumerate() {
            let places = [layout.friction(k), layout.static_friction(k)];
            for (place, expected) in places.into_iter().zip(contact.coefficients) {
                self.compare(Role::Friction, place, response.values[place], expected)?;
            }
        }
        if layout.axes == 1 {
            return Ok(());
        }
        for (k, contact) in contacts.iter().enumerate() {
            let (first, direction) = (layout.direction(k).start, response.direction(k));
            // Compared up to sign, because square roots in a field have none.
            for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)] {
                let expected = contact.reference_direction[i] * contact.reference_direction[j];
                let found = direction[i] * direction[j];
                self.compare(Role::Friction, first + j, found, expected)?;
            }
        }
        Ok(())
    }

    /// Checks that the normal reactions balance the forces that would open the guides: the
    /// equations of the relaxed machine along their normals.
    fn check_reactions(
        &self,
        at: &State<R>,
        contacts: &[LiteralSliding<R>],
        pressed: &GuideForces<'_, R>,
    ) -> Result<(), Verdict> {
        let Some(relaxed) = self.parts.relaxed else {
            return Err(Verdict::Undefined);
        };
        let guides = guides_of(relaxed.model);
        // The side of each guide on which the body is.
        let mut sides = Vec::with_capacity(contacts.len());
        for contact in contacts {
            let side = contact.side.sign();
            sides.push(if R::IS_ORDERED { side } else { R::ONE });
        }
        if !sides.iter().all(|side| side.is_finite()) {
            return Err(Verdict::Undefined);
        }
        let openings = openings(relaxed, at, contacts, (&guides, &sides));
        // The side is unknown in a field, where either is accepted. In space there are no sides.
        let is_known = R::IS_ORDERED || relaxed.model.space == Space::Space;
        let mut normals = pressed.normals.to_vec();
        let is_known = vec![is_known; contacts.len()];
        match pressed.first_unbalanced(&openings, (&guides, &sides), (&mut normals, &is_known))? {
            None => Ok(()),
            Some(contact) => {
                let point = self.number;
                Err(Disagreement::Reaction { contact, point }.into())
            }
        }
    }
}

/// The equations of the relaxed machine along the displacements that open its guides, one for each component of a reaction,
/// with the contact that it belongs to.
fn openings<R: Number>(
    relaxed: &Lagrange<'_, '_>,
    at: &State<R>,
    contacts: &[LiteralSliding<R>],
    (guides, sides): (&[usize], &[R]),
) -> Vec<(usize, Literal<R>)> {
    let n = at.q.len();
    let all = relaxed.model.coordinates.len();
    let mut at = at.clone();
    for list in [&mut at.q, &mut at.v, &mut at.a] {
        list.resize(all, R::ZERO);
    }
    let dimension = relaxed.model.space.dimension();
    let along = |k: usize, axis: &Vec<R>| {
        let mut w = vec![R::ZERO; all];
        for (i, &component) in axis.iter().enumerate() {
            w[n + dimension * guides[k] + i] = sides[k] * component;
        }
        (k, relaxed.at(&at, &w))
    };
    let mut openings = Vec::new();
    for (k, contact) in contacts.iter().enumerate() {
        openings.extend(contact.axes.iter().map(|axis| along(k, axis)));
    }
    openings
}

/// The numbers of all unilateral contacts.
struct ContactNumbers<'a, R> {
    gaps: &'a [R],
    rates: &'a [R],
    rows: &'a [R],
    biases: &'a [R],
    coefficients: &'a [R],
}

/// The forces in the guides.
#[derive(Clone, Copy)]
struct GuideForces<'a, R> {
    multipliers: &'a [R],
    friction_forces: &'a [R],
    /// The components of the normal reactions, contact after contact.
    normals: &'a [R],
    /// The number of components of a reaction.
    axes: usize,
    /// Whether the signs of the program's slips agree with the spec.
    signs: &'a [R],
}

impl<R: Number> GuideForces<'_, R> {
    /// A contact with an opening displacement along which these forces are not balanced, whatever the signs of the normal reactions that
    /// are not known; the last one if that depends on them. A displacement opens few guides, so that signs are tried for few at once, and
    /// each equation decides on those in it.
    fn first_unbalanced(
        &self,
        openings: &[(usize, Literal<R>)],
        (guides, sides): (&[usize], &[R]),
        (normals, is_known): (&mut [R], &[bool]),
    ) -> Result<Option<usize>, Verdict> {
        let Some((opening, later)) = openings.split_first() else {
            return Ok(None);
        };
        let has_effect = |off: &R| !matches!(off.test_zero(off.size()), ZeroTest::Zero);
        let unknown = |j: &usize| {
            !is_known[*j]
                && occurs_in_equation(guides, opening.0, *j)
                && opening.1.sliding[*j].off_along.iter().any(has_effect)
        };
        let open: Vec<usize> = (0..is_known.len()).filter(unknown).collect();
        if open.len() > MOST_SIGNS {
            return Err(Verdict::Undefined);
        }
        let mut is_known = is_known.to_vec();
        open.iter().for_each(|j| is_known[*j] = true);
        let mut wrong = None;
        for pattern in 0..1_usize << open.len() {
            for (place, &j) in open.iter().enumerate() {
                let is_opposite = pattern >> place & 1 != 0;
                let own = self.normals[j];
                normals[j] = if is_opposite { -own } else { own };
            }
            if !self.balance(opening, (guides, sides), normals)? {
                wrong = wrong.max(Some(opening.0));
                continue;
            }
            match self.first_unbalanced(later, (guides, sides), (&mut *normals, &is_known))? {
                None => return Ok(None),
                contact => wrong = wrong.max(contact),
            }
        }
        Ok(wrong)
    }

    /// Whether forces are balanced along a displacement with these normal reactions.
    fn balance(
        &self,
        (k, literal): &(usize, Literal<R>),
        (guides, sides): (&[usize], &[R]),
        normals: &[R],
    ) -> Result<bool, Verdict> {
        let mut open = Sum::of([literal.inertia, -literal.applied]);
        for (constraint, &multiplier) in literal.constraints.iter().zip(self.multipliers) {
            open = open.plus(-(constraint.along * multiplier));
        }
        let normals = normals.chunks_exact(self.axes);
        for ((j, contact), normals) in literal.sliding.iter().enumerate().zip(normals) {
            let friction = self.signs[j] * self.friction_forces[j];
            open = open.plus(-(contact.slip_along * friction));
            if !occurs_in_equation(guides, *k, j) {
                continue;
            }
            for (&off, &normal) in contact.off_along.iter().zip(normals) {
                open = open.plus(-(sides[j] * off * normal));
            }
        }
        if !open.value.is_finite() {
            return Err(Verdict::Undefined);
        }
        open.vanishes()
    }
}

/// The largest number of guides that one displacement opens of which the signs of the reactions are tried.
const MOST_SIGNS: usize = 12;
