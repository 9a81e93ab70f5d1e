//! The loop over the orders of a series: sums of products over earlier orders, followed by straight-line code. A register holds several sums of one state, or
//! the same sum of several states.
//!
//! A sum `Σ aⱼ bₙ₋ⱼ` goes from the middle outwards, in two sums, one towards either end of the lists: the order of terms of
//! `lagrangian_scalar::series::convolve_all`.

use iced_x86::{Code, IcedError, Instruction as Encoded, MemoryOperand, Register};

use super::{Assembled, Emitter, Layout, WORKSPACE};
use crate::Level;
use crate::encodings::{Encodings, encodings};
use crate::lower::{Arithmetic, Call, CallKind, Lowered};

/// Sums over orders that a register holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pack {
    /// How many of one state: 4 or 8; 1 where a register holds one of each of several states.
    pub width: u32,
    /// Where their factors are in a record.
    pub slots: [u32; 2],
    /// Where they are stored.
    pub sums: u32,
}

/// The sums that each order begins with.
pub struct Orders<'a> {
    /// The packs of sums of `n − 3` and of `n − 2` terms at order `n`.
    pub packs: [&'a [Pack]; 2],
    /// The record of order 2, and the distance between records, in numbers.
    pub second: u32,
    pub stride: u32,
}

/// Arguments: the numbers of the step, the record two orders ago, the number of orders left.
const NUMBERS: Register = Register::RSI;
const RECORD: Register = Register::RDX;
const LEFT: Register = Register::RCX;
/// The number of terms of the first packs.
const TERMS: Register = Register::R8;
/// The number of terms left in each of both sums, and the records of both factors.
const STEPS: Register = Register::RAX;
const COUNT: Register = Register::R9;
const LOW: Register = Register::R10;
const HIGH: Register = Register::R11;

/// Encodes the loop, whose function has the arguments `(…, numbers, record, orders, …, workspace)`.
///
/// # Errors
/// If an instruction has no encoding, which would be a defect of this module.
pub fn assemble_orders(
    lowered: &Lowered,
    orders: &Orders<'_>,
    layout: Layout,
) -> Result<Assembled, IcedError> {
    let mut emitter = Emitter::new(lowered, Arithmetic::Fused, layout);
    let mut jumps = Jumps::default();
    emitter.orders(orders, &mut jumps)?;
    let mut assembled = emitter.assembled();
    for (end, target) in jumps.0 {
        let distance = target.wrapping_sub(end) as i32;
        let end = end as usize;
        assembled.bytes[end - 4..end].copy_from_slice(&distance.to_le_bytes());
    }
    Ok(assembled)
}

/// Where jumps end, and where they lead.
#[derive(Default)]
struct Jumps(Vec<(u64, u64)>);

/// The registers of sums of one width: two sums, and one for a factor.
struct Sums {
    table: &'static Encodings,
    first: Register,
    down: u32,
    spare: u32,
}

impl Sums {
    /// Those of this index among so many.
    fn new(level: Level, width: u32, at: u32, count: u32) -> Sums {
        Sums {
            table: encodings(level, width as usize),
            first: if width == 4 {
                Register::YMM0
            } else {
                Register::ZMM0
            },
            down: 2 * at,
            spare: 2 * count + at % 2,
        }
    }

    fn register(&self, index: u32) -> Register {
        self.first + index
    }
}

impl Emitter<'_> {
    /// A number of the states.
    fn at(&self, base: Register, slot: u32) -> MemoryOperand {
        MemoryOperand::with_base_displ(base, self.bytes(slot))
    }

    /// The length of so many numbers of the states.
    fn bytes(&self, numbers: u32) -> i64 {
        (8 * self.layout.stride) as i64 * i64::from(numbers)
    }

    /// Writes the product of a matrix and the arguments of a call.
    pub(super) fn product(&mut self, call: &Call) -> Result<(), IcedError> {
        let CallKind::Matrix(matrix) = call.kind else {
            return Ok(());
        };
        let (level, most) = (self.layout.level, self.widest());
        // The registers of some rows, of which each has one or two sums.
        let rows = (0..matrix.rows).step_by(most as usize);
        let chunks: Vec<u32> = rows.collect();
        for chunks in chunks.chunks(self.at_once()) {
            let sums: Vec<(Sums, u32)> = (0..)
                .zip(chunks)
                .map(|(at, row)| {
                    let width = if matrix.rows - row <= 4 { 4 } else { most };
                    (Sums::new(level, width, at, chunks.len() as u32), *row)
                })
                .collect();
            for (sums, _) in &sums {
                self.clear(sums)?;
            }
            for column in 0..call.arguments.len() as u32 {
                let factor = call.from + column;
                let factor = MemoryOperand::with_base_displ(WORKSPACE, self.in_workspace(factor));
                let (first, _) = &sums[0];
                let all = first.register(first.spare);
                if let Some(broadcast) = first.table.broadcast {
                    self.put(Encoded::with2(broadcast, all, factor)?)?;
                }
                let side = u32::from(matrix.is_split) * (column % 2);
                for (sums, row) in &sums {
                    let elements = self.at(NUMBERS, matrix.place + column * matrix.stride + row);
                    let to = sums.register(sums.down + side);
                    let factor = sums.register(first.spare);
                    let code = sums.table.fused[0][2];
                    self.put(Encoded::with3(code, to, factor, elements)?)?;
                }
            }
            for (sums, row) in &sums {
                let [down, up] = [0, 1].map(|side| sums.register(sums.down + side));
                if matrix.is_split {
                    self.put(Encoded::with3(sums.table.add, down, down, up)?)?;
                }
                let to =
                    MemoryOperand::with_base_displ(WORKSPACE, self.in_workspace(call.to + row));
                self.put(Encoded::with2(sums.table.store, to, down)?)?;
            }
        }
        Ok(())
    }

    /// The numbers of the longest register.
    fn widest(&self) -> u32 {
        match self.layout.level {
            Level::Avx512 => 8,
            Level::Avx2 => 4,
        }
    }

    /// How many pairs of sums are made at once: two registers of every three hold sums.
    fn at_once(&self) -> usize {
        match self.layout.level {
            Level::Avx512 => 12,
            Level::Avx2 => 6,
        }
    }

    /// Sets both sums to 0.
    fn clear(&mut self, sums: &Sums) -> Result<(), IcedError> {
        for index in [sums.down, sums.down + 1] {
            let register = sums.register(index);
            self.put(Encoded::with3(
                sums.table.xor,
                register,
                register,
                register,
            )?)?;
        }
        Ok(())
    }

    fn orders(&mut self, orders: &Orders<'_>, jumps: &mut Jumps) -> Result<(), IcedError> {
        self.put(Encoded::with1(Code::Push_r64, WORKSPACE)?)?;
        self.put(Encoded::with2(Code::Mov_r64_rm64, WORKSPACE, Register::R9)?)?;
        self.put(Encoded::with2(Code::Mov_r32_imm32, Register::R8D, 0)?)?;
        let top = self.place;
        for (more, packs) in orders.packs.into_iter().enumerate() {
            for packs in packs.chunks(self.at_once()) {
                self.sweep(packs, more as i64, orders, jumps)?;
            }
        }
        let lowered = self.lowered;
        for (number, phase) in lowered.phases.iter().enumerate() {
            for id in &phase.order {
                self.instruction(*id)?;
            }
            if !phase.calls.is_empty() {
                self.calls(number)?;
            }
        }
        self.copy_results()?;
        let stride = self.bytes(orders.stride) as i32;
        self.put(Encoded::with2(Code::Add_rm64_imm32, RECORD, stride)?)?;
        self.put(Encoded::with1(Code::Inc_rm64, TERMS)?)?;
        self.put(Encoded::with1(Code::Dec_rm64, LEFT)?)?;
        self.jump_back(Code::Jne_rel32_64, top)?;
        self.put(Encoded::with(Code::VEX_Vzeroupper))?;
        self.put(Encoded::with1(Code::Pop_r64, WORKSPACE)?)?;
        self.put(Encoded::with(Code::Retnq))
    }

    fn jump_back(&mut self, code: Code, target: u64) -> Result<(), IcedError> {
        self.put(Encoded::with_branch(code, target)?)
    }

    /// A jump whose target is not known yet; returns where its instruction ends.
    fn jump(&mut self, code: Code) -> Result<u64, IcedError> {
        self.put(Encoded::with_branch(code, self.place)?)?;
        Ok(self.place)
    }

    /// Computes the sums of these packs, which have `more` terms than the number in its register.
    fn sweep(
        &mut self,
        packs: &[Pack],
        more: i64,
        orders: &Orders<'_>,
        jumps: &mut Jumps,
    ) -> Result<(), IcedError> {
        let count = packs.len() as u32;
        let all = (0..).zip(packs).map(|(at, pack)| {
            let width = pack.width.max(self.layout.lanes as u32);
            let sums = Sums::new(self.layout.level, width, at, count);
            (sums, *pack)
        });
        let all: Vec<(Sums, Pack)> = all.collect();
        let stride = self.bytes(orders.stride) as i32;
        let count = MemoryOperand::with_base_displ(TERMS, more);
        self.put(Encoded::with2(Code::Lea_r64_m, COUNT, count)?)?;
        self.put(Encoded::with2(Code::Mov_r64_rm64, STEPS, COUNT)?)?;
        self.put(Encoded::with2(Code::Shr_rm64_imm8, STEPS, 1)?)?;
        self.put(Encoded::with3(
            Code::Imul_r64_rm64_imm32,
            LOW,
            STEPS,
            stride,
        )?)?;
        let middle = MemoryOperand::with_base_index_scale_displ_size(
            NUMBERS,
            LOW,
            1,
            self.bytes(orders.second),
            8,
        );
        self.put(Encoded::with2(Code::Lea_r64_m, LOW, middle)?)?;
        self.put(Encoded::with2(Code::Mov_r64_rm64, HIGH, LOW)?)?;
        for (sums, _) in &all {
            self.clear(sums)?;
        }
        // The term in the middle of an odd number.
        self.put(Encoded::with2(Code::Test_rm32_imm32, Register::R9D, 1)?)?;
        let is_even = self.jump(Code::Je_rel32_64)?;
        for (sums, pack) in &all {
            self.term((sums, pack), sums.down, [LOW, LOW])?;
        }
        self.put(Encoded::with2(Code::Add_rm64_imm32, HIGH, stride)?)?;
        jumps.0.push((is_even, self.place));
        self.put(Encoded::with2(Code::Sub_rm64_imm32, LOW, stride)?)?;
        self.put(Encoded::with2(Code::Test_rm64_r64, STEPS, STEPS)?)?;
        let is_done = self.jump(Code::Je_rel32_64)?;
        let top = self.place;
        for (sums, pack) in &all {
            self.term((sums, pack), sums.down, [LOW, HIGH])?;
            self.term((sums, pack), sums.down + 1, [HIGH, LOW])?;
        }
        self.put(Encoded::with2(Code::Sub_rm64_imm32, LOW, stride)?)?;
        self.put(Encoded::with2(Code::Add_rm64_imm32, HIGH, stride)?)?;
        self.put(Encoded::with1(Code::Dec_rm64, STEPS)?)?;
        self.jump_back(Code::Jne_rel32_64, top)?;
        jumps.0.push((is_done, self.place));
        for (sums, pack) in &all {
            let [down, up] = [0, 1].map(|side| sums.register(sums.down + side));
            self.put(Encoded::with3(sums.table.add, down, down, up)?)?;
            let to = self.at(NUMBERS, pack.sums);
            self.put(Encoded::with2(sums.table.store, to, down)?)?;
        }
        Ok(())
    }

    /// Adds a term to a sum, whose factors are in these records.
    fn term(
        &mut self,
        (sums, pack): (&Sums, &Pack),
        to: u32,
        records: [Register; 2],
    ) -> Result<(), IcedError> {
        let [a, b] = [0, 1].map(|side| self.at(records[side], pack.slots[side]));
        let spare = sums.register(sums.spare);
        self.put(Encoded::with2(sums.table.load, spare, a)?)?;
        let code = sums.table.fused[0][2];
        self.put(Encoded::with3(code, sums.register(to), spare, b)?)
    }
}
