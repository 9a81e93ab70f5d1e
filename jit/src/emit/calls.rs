//! Calls between phases of arithmetic.

use iced_x86::{Code, IcedError, Instruction as Encoded, MemoryOperand, Register};

use super::{ADDRESSES, BROUGHT, Emitter, Goal, NEVER, WORKSPACE, saved};
use crate::external;
use crate::lower::{Base, Call, CallKind, Node};

impl Emitter<'_> {
    /// Makes the calls of a phase, for which no value may be in a register.
    pub(super) fn calls(&mut self, phase: usize) -> Result<(), IcedError> {
        let lowered = self.lowered;
        let calls = &lowered.phases[phase].calls;
        for call in calls {
            for (index, id) in call.arguments.iter().enumerate() {
                // Computed values were stored at their goals already.
                if let Node::Leaf(place) = lowered.nodes[*id as usize] {
                    self.copy(place, Goal::Workspace(call.from + index as u32))?;
                }
            }
        }
        for index in 0..self.held.len() as u8 {
            if let Some(id) = self.held[index as usize]
                && self.next(id) != NEVER
            {
                self.save(index)?;
            }
            self.release(index);
        }
        if calls.iter().all(is_inline) {
            return calls.iter().try_for_each(|call| self.product(call));
        }
        if !std::mem::replace(&mut self.are_saved, true) {
            for (base, register) in ADDRESSES.iter().enumerate().take(BROUGHT) {
                if self.lowered.reads[base] > 0 {
                    let header = MemoryOperand::with_base_displ(WORKSPACE, saved(base));
                    self.put(Encoded::with2(Code::Mov_rm64_r64, header, *register)?)?;
                }
            }
        }
        if self.layout.lanes > 1 {
            // The called functions may use SSE instructions, which are slow while the upper halves of registers are in use.
            self.put(Encoded::with(Code::VEX_Vzeroupper))?;
        }
        for call in calls {
            let function = external::address(
                call.kind,
                self.arithmetic,
                self.layout.lanes,
                call.arguments.len(),
            );
            let Some(function) = function else {
                self.product(call)?;
                continue;
            };
            let from = MemoryOperand::with_base_displ(WORKSPACE, self.in_workspace(call.from));
            let to = MemoryOperand::with_base_displ(WORKSPACE, self.in_workspace(call.to));
            let count = call.arguments.len() as u32;
            self.put(Encoded::with2(Code::Lea_r64_m, Register::RDI, from)?)?;
            self.put(Encoded::with2(Code::Lea_r64_m, Register::RSI, to)?)?;
            self.put(Encoded::with2(Code::Mov_r32_imm32, Register::EDX, count)?)?;
            self.put(Encoded::with2(
                Code::Mov_r64_imm64,
                Register::RAX,
                function as u64,
            )?)?;
            self.put(Encoded::with1(Code::Call_rm64, Register::RAX)?)?;
        }
        self.is_loaded = [false; Base::COUNT];
        Ok(())
    }
}

/// Whether a call is written in line.
pub(super) fn is_inline(call: &Call) -> bool {
    matches!(call.kind, CallKind::Matrix(_))
}
