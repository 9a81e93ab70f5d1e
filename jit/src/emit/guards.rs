//! Guards: whether the pivots of a function are large enough, as a bit for each lane.

use iced_x86::{Code, IcedError, Instruction as Encoded, Register};

use super::{Emitter, GUARDS};
use crate::Level;

impl Emitter<'_> {
    /// The register that accumulates guards with AVX2.
    pub(super) fn guards(&self) -> Register {
        self.register(15)
    }

    pub(super) fn start_guards(&mut self) -> Result<(), IcedError> {
        match self.layout.level {
            Level::Avx512 => self.put(Encoded::with3(
                Code::VEX_Kxnorb_kr_kr_kr,
                GUARDS,
                GUARDS,
                GUARDS,
            )?),
            Level::Avx2 => {
                let code = match self.layout.lanes {
                    1 => Code::VEX_Vpcmpeqd_xmm_xmm_xmmm128,
                    _ => Code::VEX_Vpcmpeqd_ymm_ymm_ymmm256,
                };
                let guards = self.guards();
                self.put(Encoded::with3(code, guards, guards, guards)?)
            }
        }
    }

    /// Leaves a bit for each lane in EAX, which is set if its guards hold.
    pub(super) fn finish_guards(&mut self) -> Result<(), IcedError> {
        let (level, lanes) = (self.layout.level, self.layout.lanes);
        self.put(match level {
            _ if !self.lowered.is_guarded => {
                Encoded::with2(Code::Mov_r32_imm32, Register::EAX, (1u32 << lanes) - 1)?
            }
            Level::Avx512 => Encoded::with2(Code::VEX_Kmovb_r32_kr, Register::EAX, GUARDS)?,
            Level::Avx2 => {
                let code = match lanes {
                    1 => Code::VEX_Vmovmskpd_r32_xmm,
                    _ => Code::VEX_Vmovmskpd_r32_ymm,
                };
                Encoded::with2(code, Register::EAX, self.guards())?
            }
        })
    }
}
