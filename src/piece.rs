//! Pieces of time in which inputs are smooth.

/// An interval of time within which inputs are smooth. They may jump or have a kink at its ends, where the steps of a
/// [`Simulation`](crate::Simulation) end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Its beginning, in s; −∞ if it has none.
    pub from: f64,
    /// Its end, later than its beginning, in s; ∞ if it has none.
    pub to: f64,
    /// Whether the inputs jump where a run enters it (at its end, if the run goes backward in time); otherwise they are continuous there.
    pub jumps: bool,
}

/// Why there is no piece after an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPiece<'a> {
    /// The input, or table, with this name is not known there.
    Ended(&'a str),
    /// The input, or table, with this name changes more often there than the resolution of time.
    TooFine(&'a str),
}

impl Piece {
    /// All of time.
    pub const ALL: Piece = Piece {
        from: f64::NEG_INFINITY,
        to: f64::INFINITY,
        jumps: false,
    };

    /// Where a run leaves it, in s; infinite if it does not.
    pub fn end(&self, forward: bool) -> f64 {
        if forward { self.to } else { self.from }
    }

    /// Where a run enters it, in s.
    pub fn beginning(&self, forward: bool) -> f64 {
        self.end(!forward)
    }

    /// The intersection with another piece. A run enters it where it enters the later of the two.
    #[must_use]
    pub fn and(self, other: Piece, forward: bool) -> Piece {
        let entered = |piece: &Piece| if forward { piece.from } else { -piece.to };
        let jumps = match (entered(&self), entered(&other)) {
            (one, two) if one > two => self.jumps,
            (one, two) if one < two => other.jumps,
            _ => self.jumps || other.jumps,
        };
        Piece {
            from: self.from.max(other.from),
            to: self.to.min(other.to),
            jumps,
        }
    }

    /// An instant in its interior, at which everything that is constant within it can be evaluated. `t` itself if it
    /// is all of time.
    pub fn within(&self, t: f64) -> f64 {
        match (self.from.is_finite(), self.to.is_finite()) {
            (true, true) => 0.5 * self.from + 0.5 * self.to,
            (true, false) => self.from + self.from.abs().max(1.0),
            (false, true) => self.to - self.to.abs().max(1.0),
            (false, false) => t,
        }
    }
}
