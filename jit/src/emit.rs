//! The code generator: machine code of a function, in one pass over its instructions.
//!
//! Values stay in registers as long as possible. When a register is needed and none is free, the value with the furthest
//! next use is evicted (L. A. Belady, *A study of replacement algorithms for a virtual-storage computer*, IBM Systems
//! Journal 5 (1966) 78–101), and written to memory unless it is already there. Arguments and constants are used as memory
//! operands wherever an instruction allows one.
//!
//! Invariant between instructions: a value that is still needed is in a register or in memory.

mod calls;
mod guards;
mod orders;

use iced_x86::{Code, Encoder, IcedError, Instruction as Encoded, MemoryOperand, Register};
use lagrangian_program::Contracted;

use super::Level;
use super::encodings::{Encodings, encodings};
use super::lower::{Arithmetic, Base, Id, Instruction, Location, Lowered, Node, Predicate};
use super::work::Work;
use calls::is_inline;
pub use orders::{Orders, Pack, assemble_orders};

/// The size of the header of the workspace in bytes; it holds the addresses of arguments.
pub const HEADER: usize = 128;

/// The number of states that code evaluates at once, and the arrangement of their numbers in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Layout {
    /// The instructions that the processor has.
    pub level: Level,
    /// The number of states that an instruction processes.
    pub lanes: usize,
    /// The distance from a number of a state to its next, in numbers: the number of states side by side.
    pub stride: usize,
    /// The distance from a prepared value to the next, in numbers: 1 where all lanes share them, which only AVX-512 can
    /// read; otherwise one for each lane, or more.
    pub known_stride: usize,
}

impl Layout {
    /// The bytes of a register.
    pub fn width(self) -> usize {
        8 * self.lanes
    }
}

/// Code with its requirements.
#[derive(Debug)]
pub struct Assembled {
    /// Constants, followed by the code.
    pub bytes: Vec<u8>,
    /// The offset of the entry point.
    pub entry: usize,
    /// The number of register-sized slots that it needs in the workspace.
    pub workspace: usize,
    /// The amount of work of generating it.
    pub work: Work,
}

/// Code is aligned to cache lines.
const LINE: usize = 64;

/// The position of a next use that does not exist.
const NEVER: u32 = u32::MAX;

/// The registers that hold the addresses of arguments. The first five are passed by the caller.
const ADDRESSES: [Register; Base::COUNT] = [
    Register::RDI, // time
    Register::RSI, // coordinates
    Register::RDX, // velocities
    Register::RCX, // inputs
    Register::R8,  // prepared values
    Register::R9,  // accelerations
    Register::R10, // results of the stage of time
    Register::R11, // results of the stage of position
    Register::RAX, // results
];

/// How many of [`ADDRESSES`] the caller passes; it passes the workspace in R9.
const BROUGHT: usize = 5;

/// The address of the workspace, in a callee-saved register.
const WORKSPACE: Register = Register::RBX;

/// With AVX-512: the mask of guards that hold, and the mask of the last comparison.
const GUARDS: Register = Register::K1;
const COMPARED: Register = Register::K2;

/// Encodes a function.
///
/// # Errors
/// If an instruction has no encoding, which would be a defect of this module.
pub fn assemble(
    lowered: &Lowered,
    arithmetic: Arithmetic,
    layout: Layout,
) -> Result<Assembled, IcedError> {
    let mut emitter = Emitter::new(lowered, arithmetic, layout);
    emitter.function()?;
    Ok(emitter.assembled())
}

struct Emitter<'a> {
    lowered: &'a Lowered,
    arithmetic: Arithmetic,
    layout: Layout,
    table: &'static Encodings,
    encoder: Encoder,
    /// The constants, and the distance between them in bytes.
    pool: Vec<u8>,
    constant_stride: usize,
    /// The offset of the first instruction, and of the next one.
    start: usize,
    place: u64,
    /// The uses of value i are `uses[first_use[i]..first_use[i + 1]]`; those before `next_use[i]` are past.
    uses: Vec<u32>,
    first_use: Vec<u32>,
    next_use: Vec<u32>,
    /// The value in each register, and the register of each value.
    held: Vec<Option<Id>>,
    register_of: Vec<Option<u8>>,
    /// The memory location of each value.
    home: Vec<Option<Location>>,
    /// Whether that location is a workspace slot that can be reused afterwards.
    is_borrowed: Vec<bool>,
    free_slots: Vec<u32>,
    slots: u32,
    /// Where each value must also be stored: as an argument of a call, or as a result.
    wanted: Vec<(Id, Goal)>,
    /// Which argument addresses are in their registers.
    is_loaded: [bool; Base::COUNT],
    /// Whether the addresses that the caller passes are in the workspace.
    are_saved: bool,
    work: Work,
}

/// A location where a value is stored as soon as it is computed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Goal {
    /// An argument of a call, in the workspace.
    Workspace(u32),
    /// A number of an argument.
    Argument(Base, u32),
}

/// The positions at which each value is used: those of value i are `uses[first_use[i]..first_use[i + 1]]` of the results.
fn uses_of(lowered: &Lowered) -> (Vec<u32>, Vec<u32>) {
    let count = lowered.nodes.len();
    let order = || lowered.phases.iter().flat_map(|phase| &phase.order);
    let mut first_use = vec![0u32; count + 1];
    for id in order() {
        for operand in lowered.nodes[*id as usize].operands() {
            first_use[operand as usize + 1] += 1;
        }
    }
    for index in 0..count {
        first_use[index + 1] += first_use[index];
    }
    let mut next: Vec<u32> = first_use[..count].to_vec();
    let mut uses = vec![0; first_use[count] as usize];
    for (position, id) in order().enumerate() {
        for operand in lowered.nodes[*id as usize].operands() {
            let next = &mut next[operand as usize];
            uses[*next as usize] = position as u32;
            *next += 1;
        }
    }
    (first_use, uses)
}

/// Where each value is stored, sorted.
fn goals(lowered: &Lowered) -> Vec<(Id, Goal)> {
    let mut wanted: Vec<(Id, Goal)> = Vec::new();
    for call in lowered.phases.iter().flat_map(|phase| &phase.calls) {
        for (index, id) in call.arguments.iter().enumerate() {
            wanted.push((*id, Goal::Workspace(call.from + index as u32)));
        }
    }
    for (id, base, index) in &lowered.results {
        wanted.push((*id, Goal::Argument(*base, *index)));
    }
    wanted.sort_unstable();
    wanted
}

impl<'a> Emitter<'a> {
    fn new(lowered: &'a Lowered, arithmetic: Arithmetic, layout: Layout) -> Emitter<'a> {
        let count = lowered.nodes.len();
        // AVX-512 broadcasts a single number to all lanes; otherwise constants are as long as registers, at least two
        // numbers, because bitwise instructions read at least 128 bits.
        let copies = match layout.level {
            Level::Avx512 => 1,
            Level::Avx2 => layout.lanes.max(2),
        };
        let mut pool = Vec::new();
        for bits in &lowered.constants {
            for _ in 0..copies {
                pool.extend_from_slice(&bits.to_le_bytes());
            }
        }
        let start = pool.len().next_multiple_of(LINE);

        let (first_use, uses) = uses_of(lowered);
        let home = lowered.nodes.iter().map(|node| match node {
            Node::Leaf(place) => Some(*place),
            _ => None,
        });
        let registers = match layout.level {
            Level::Avx512 => 32,
            // The last register is reserved for the guards.
            Level::Avx2 => 16 - usize::from(lowered.is_guarded),
        };
        let mut is_loaded = [false; Base::COUNT];
        is_loaded[..BROUGHT].fill(true);
        Emitter {
            lowered,
            arithmetic,
            layout,
            table: encodings(layout.level, layout.lanes),
            encoder: Encoder::new(64),
            pool,
            constant_stride: 8 * copies,
            start,
            place: start as u64,
            uses,
            next_use: first_use[..count].to_vec(),
            first_use,
            held: vec![None; registers],
            register_of: vec![None; count],
            home: home.collect(),
            is_borrowed: vec![false; count],
            free_slots: Vec::new(),
            slots: lowered.workspace,
            wanted: goals(lowered),
            is_loaded,
            are_saved: false,
            work: Work::default(),
        }
    }

    /// The code with everything that was written.
    fn assembled(mut self) -> Assembled {
        let entry = self.start;
        let mut bytes = self.pool;
        bytes.resize(entry, 0);
        bytes.extend(self.encoder.take_buffer());
        Assembled {
            bytes,
            entry,
            workspace: self.slots as usize,
            work: self.work,
        }
    }

    fn function(&mut self) -> Result<(), IcedError> {
        // This also aligns the stack as calls require.
        self.put(Encoded::with1(Code::Push_r64, WORKSPACE)?)?;
        self.put(Encoded::with2(Code::Mov_r64_rm64, WORKSPACE, Register::R9)?)?;
        let lowered = self.lowered;
        let phases = &lowered.phases;
        for (number, phase) in phases.iter().enumerate() {
            let is_last = number + 1 == phases.len();
            if is_last && self.lowered.is_guarded {
                self.start_guards()?;
            }
            for id in &phase.order {
                self.instruction(*id)?;
            }
            if !is_last {
                self.calls(number)?;
            }
        }
        self.copy_results()?;
        self.finish_guards()?;
        let mut calls = phases.iter().flat_map(|phase| &phase.calls);
        if self.layout.lanes > 1 || calls.any(is_inline) {
            self.put(Encoded::with(Code::VEX_Vzeroupper))?;
        }
        self.put(Encoded::with1(Code::Pop_r64, WORKSPACE)?)?;
        self.put(Encoded::with(Code::Retnq))
    }

    /// Stores results that are arguments, constants, or results of calls.
    fn copy_results(&mut self) -> Result<(), IcedError> {
        let lowered = self.lowered;
        for (id, base, index) in &lowered.results {
            if let Node::Leaf(place) = lowered.nodes[*id as usize] {
                self.copy(place, Goal::Argument(*base, *index))?;
            }
        }
        Ok(())
    }

    // Registers and memory.

    fn put(&mut self, instruction: Encoded) -> Result<(), IcedError> {
        self.place += self.encoder.encode(&instruction, self.place)? as u64;
        self.work.instructions += 1;
        Ok(())
    }

    /// The vector register of this index in the width of the layout.
    fn register(&self, index: u8) -> Register {
        let first = match self.layout.lanes {
            1 => Register::XMM0,
            4 => Register::YMM0,
            _ => Register::ZMM0,
        };
        first + u32::from(index)
    }

    /// The register with the address of an argument, loaded if necessary.
    fn address(&mut self, base: Base) -> Result<Register, IcedError> {
        let register = ADDRESSES[base as usize];
        if !std::mem::replace(&mut self.is_loaded[base as usize], true) {
            let header = MemoryOperand::with_base_displ(WORKSPACE, saved(base as usize));
            self.put(Encoded::with2(Code::Mov_r64_rm64, register, header)?)?;
        }
        Ok(register)
    }

    /// A location as a memory operand.
    fn operand(&mut self, place: Location) -> Result<MemoryOperand, IcedError> {
        let is_wide = self.layout.lanes > 1;
        let (base, displacement, is_broadcast) = match place {
            Location::Constant(index) => {
                let address = index as usize * self.constant_stride;
                let is_broadcast = is_wide && self.layout.level == Level::Avx512;
                (Register::RIP, address as i64, is_broadcast)
            }
            Location::Argument(base, index) => {
                let stride = match base {
                    Base::Known => self.layout.known_stride,
                    _ => self.layout.stride,
                };
                let register = self.address(base)?;
                let displacement = 8 * stride * index as usize;
                (register, displacement as i64, is_wide && stride == 1)
            }
            Location::Workspace(index) => (WORKSPACE, self.in_workspace(index), false),
        };
        let mut operand = MemoryOperand::with_base_displ(base, displacement);
        operand.is_broadcast = is_broadcast;
        Ok(operand)
    }

    fn in_workspace(&self, index: u32) -> i64 {
        (HEADER + index as usize * self.layout.width()) as i64
    }

    /// The next position at which a value is used.
    fn next(&self, id: Id) -> u32 {
        let id = id as usize;
        if self.next_use[id] < self.first_use[id + 1] {
            self.uses[self.next_use[id] as usize]
        } else {
            NEVER
        }
    }

    /// A free register for a value, by eviction if necessary; the registers in `but` are not evicted.
    fn take(&mut self, but: &[Option<u8>]) -> Result<u8, IcedError> {
        let mut furthest: Option<(u32, u8)> = None;
        for index in 0..self.held.len() {
            self.work.looks += 1;
            let Some(id) = self.held[index] else {
                if but.contains(&Some(index as u8)) {
                    continue;
                }
                return Ok(index as u8);
            };
            let index = index as u8;
            if but.contains(&Some(index)) {
                continue;
            }
            let next = self.next(id);
            if furthest.is_none_or(|(other, _)| next > other) {
                furthest = Some((next, index));
            }
        }
        // There are more registers than the three operands of an instruction.
        let (next, index) = furthest.unwrap_or((NEVER, 0));
        if next != NEVER {
            self.work.evictions += 1;
            self.save(index)?;
        }
        self.release(index);
        Ok(index)
    }

    /// Stores the value of a register in memory, unless it is already there.
    fn save(&mut self, index: u8) -> Result<(), IcedError> {
        let Some(id) = self.held[index as usize] else {
            return Ok(());
        };
        if self.home[id as usize].is_none() {
            let slot = self.free_slots.pop().unwrap_or(self.slots);
            self.slots = self.slots.max(slot + 1);
            self.home[id as usize] = Some(Location::Workspace(slot));
            self.is_borrowed[id as usize] = true;
            self.store(index, Goal::Workspace(slot))?;
        }
        Ok(())
    }

    /// Marks a register as free.
    fn release(&mut self, index: u8) {
        if let Some(id) = self.held[index as usize].take() {
            self.register_of[id as usize] = None;
        }
    }

    fn hold(&mut self, index: u8, id: Id) {
        self.release(index);
        self.held[index as usize] = Some(id);
        self.register_of[id as usize] = Some(index);
    }

    fn store(&mut self, index: u8, goal: Goal) -> Result<(), IcedError> {
        let to = match goal {
            Goal::Workspace(slot) => {
                MemoryOperand::with_base_displ(WORKSPACE, self.in_workspace(slot))
            }
            Goal::Argument(base, index) => {
                let register = self.address(base)?;
                let displacement = 8 * self.layout.stride * index as usize;
                MemoryOperand::with_base_displ(register, displacement as i64)
            }
        };
        let from = self.register(index);
        self.put(Encoded::with2(self.table.store, to, from)?)
    }

    /// Loads a location into a register.
    fn read(&mut self, index: u8, place: Location) -> Result<(), IcedError> {
        let mut from = self.operand(place)?;
        let to = self.register(index);
        let code = match (from.is_broadcast, self.table.broadcast) {
            (true, Some(broadcast)) => {
                // The instruction itself broadcasts.
                from.is_broadcast = false;
                broadcast
            }
            _ => self.table.load,
        };
        self.put(Encoded::with2(code, to, from)?)
    }

    /// Copies a location to a goal.
    fn copy(&mut self, from: Location, to: Goal) -> Result<(), IcedError> {
        let index = self.take(&[])?;
        self.read(index, from)?;
        self.store(index, to)
    }

    /// The register of a value, which is loaded from memory if necessary.
    fn in_register(&mut self, id: Id, but: &[Option<u8>]) -> Result<u8, IcedError> {
        if let Some(index) = self.register_of[id as usize] {
            return Ok(index);
        }
        let index = self.take(but)?;
        if let Some(place) = self.home[id as usize] {
            self.read(index, place)?;
        }
        self.hold(index, id);
        Ok(index)
    }

    // Instructions.

    fn instruction(&mut self, id: Id) -> Result<(), IcedError> {
        match self.lowered.nodes[id as usize] {
            Node::Leaf(_) => Ok(()),
            Node::Binary(instruction, a, b) => {
                let code = self.code(instruction);
                let (a, b) = if instruction.is_symmetric() && self.is_better_second(a, b) {
                    (b, a)
                } else {
                    (a, b)
                };
                let (a, last) = self.pair(a, b, instruction.is_of_bits())?;
                let to = self.result(id)?;
                let (to_register, first) = (self.register(to), self.register(a));
                self.put(match last {
                    Last::Register(b) => {
                        Encoded::with3(code, to_register, first, self.register(b))?
                    }
                    Last::Memory(place) => Encoded::with3(code, to_register, first, place)?,
                })?;
                self.done(id, to)
            }
            Node::Root(a) => {
                let a = self.in_register(a, &[])?;
                self.past(id);
                let to = self.take(&[])?;
                let (to_register, from) = (self.register(to), self.register(a));
                self.put(match self.layout.lanes {
                    1 => Encoded::with3(self.table.sqrt, to_register, from, from)?,
                    _ => Encoded::with2(self.table.sqrt, to_register, from)?,
                })?;
                self.hold(to, id);
                self.done(id, to)
            }
            Node::Contracted(kind, factors, term) => self.contracted(id, kind, factors, term),
            Node::Compare(predicate, a, b) => {
                let (a, last) = self.pair(a, b, false)?;
                let to = self.result(id)?;
                let into = match self.layout.level {
                    Level::Avx512 => COMPARED,
                    Level::Avx2 => self.register(to),
                };
                let compare = self.comparison(predicate, into, a, last)?;
                self.put(compare)?;
                if let Some(spread) = self.table.spread {
                    // A register for one number is as long as one for two.
                    self.put(Encoded::with2(spread, self.register(to), COMPARED)?)?;
                }
                self.done(id, to)
            }
            Node::Guard(pivot, bound) => {
                let (a, last) = self.pair(pivot, bound, false)?;
                match self.layout.level {
                    Level::Avx512 => {
                        let mut compare = self.comparison(Predicate::Greater, GUARDS, a, last)?;
                        // The guards that held so far and hold here.
                        compare.set_op_mask(GUARDS);
                        self.put(compare)?;
                    }
                    Level::Avx2 => {
                        let second = match last {
                            Last::Register(index) => Some(index),
                            Last::Memory(_) => None,
                        };
                        let to = self.take(&[Some(a), second])?;
                        let into = self.register(to);
                        let compare = self.comparison(Predicate::Greater, into, a, last)?;
                        self.put(compare)?;
                        let guards = self.guards();
                        self.put(Encoded::with3(self.table.and, guards, guards, into)?)?;
                    }
                }
                self.past(id);
                self.give_back(id);
                Ok(())
            }
        }
    }

    fn code(&self, instruction: Instruction) -> Code {
        match instruction {
            Instruction::Add => self.table.add,
            Instruction::Sub => self.table.sub,
            Instruction::Mul => self.table.mul,
            Instruction::Div => self.table.div,
            Instruction::Min => self.table.min,
            Instruction::Max => self.table.max,
            Instruction::And => self.table.and,
            Instruction::Or => self.table.or,
            Instruction::Xor => self.table.xor,
        }
    }

    fn comparison(
        &self,
        predicate: Predicate,
        into: Register,
        a: u8,
        last: Last,
    ) -> Result<Encoded, IcedError> {
        let (code, first, predicate) = (self.table.compare, self.register(a), predicate as u32);
        match last {
            Last::Register(b) => Encoded::with4(code, into, first, self.register(b), predicate),
            Last::Memory(place) => Encoded::with4(code, into, first, place, predicate),
        }
    }

    /// Whether the first of two operands is in memory and the second is not, so that they should be swapped.
    fn is_better_second(&self, a: Id, b: Id) -> bool {
        let is_held = |id: Id| self.register_of[id as usize].is_some();
        !is_held(a) && is_held(b)
    }

    /// The operands of an instruction: the first in a register, the second in memory if it is in no register.
    fn pair(&mut self, a: Id, b: Id, is_of_bits: bool) -> Result<(u8, Last), IcedError> {
        let other = self.register_of[b as usize];
        let a = self.in_register(a, &[other])?;
        Ok((a, self.last(b, &[Some(a)], is_of_bits)?))
    }

    /// An operand that may be in memory.
    fn last(&mut self, id: Id, but: &[Option<u8>], is_of_bits: bool) -> Result<Last, IcedError> {
        let place = match (self.register_of[id as usize], self.home[id as usize]) {
            (None, Some(place)) => place,
            _ => return Ok(Last::Register(self.in_register(id, but)?)),
        };
        // Bitwise instructions read two numbers where there is one lane.
        let is_long = is_of_bits && self.layout.lanes == 1;
        Ok(match (self.layout.level, place) {
            (Level::Avx512, _) => {
                let mut operand = self.operand(place)?;
                operand.is_broadcast |= is_long;
                Last::Memory(operand)
            }
            // Constants are stored twice; after other numbers the memory may end.
            (Level::Avx2, Location::Argument(..) | Location::Workspace(_)) if is_long => {
                Last::Register(self.in_register(id, but)?)
            }
            (Level::Avx2, _) => Last::Memory(self.operand(place)?),
        })
    }

    /// The register for the result of an instruction whose operands are in registers. It may be one of theirs,
    /// because an instruction reads before it writes.
    fn result(&mut self, id: Id) -> Result<u8, IcedError> {
        self.past(id);
        let to = self.take(&[])?;
        self.hold(to, id);
        Ok(to)
    }

    /// Counts the uses of the operands of a value; an operand without further uses leaves its register.
    fn past(&mut self, id: Id) {
        for operand in self.lowered.nodes[id as usize].operands() {
            let next = &mut self.next_use[operand as usize];
            if *next < self.first_use[operand as usize + 1] {
                *next += 1;
            }
            if self.next(operand) == NEVER
                && let Some(index) = self.register_of[operand as usize]
            {
                self.release(index);
            }
        }
    }

    /// Frees the slots of operands without further uses, now that the instruction is written.
    fn give_back(&mut self, id: Id) {
        for operand in self.lowered.nodes[id as usize].operands() {
            if self.next(operand) == NEVER
                && std::mem::replace(&mut self.is_borrowed[operand as usize], false)
                && let Some(Location::Workspace(slot)) = self.home[operand as usize].take()
            {
                self.free_slots.push(slot);
            }
        }
    }

    /// Stores a value that is now in its register at its goals.
    fn done(&mut self, id: Id, index: u8) -> Result<(), IcedError> {
        let first = self.wanted.partition_point(|(other, _)| *other < id);
        for place in first..self.wanted.len() {
            let (other, goal) = self.wanted[place];
            if other != id {
                break;
            }
            self.store(index, goal)?;
            if let Goal::Workspace(slot) = goal {
                // The slot belongs to this value, so it need not be stored elsewhere.
                self.home[id as usize] = Some(Location::Workspace(slot));
            }
        }
        self.give_back(id);
        if self.next(id) == NEVER {
            self.release(index);
        }
        Ok(())
    }

    /// A fused operation overwrites one of its operands. The form that needs the fewest copies is chosen.
    fn contracted(
        &mut self,
        id: Id,
        kind: Contracted,
        factors: [Id; 2],
        term: Id,
    ) -> Result<(), IcedError> {
        let [a, b] = factors;
        // The overwritten operand, the operand in a register, the operand that may be in memory; and the index of the
        // form, in the numbering of instructions: `first = first·third + second` is 132.
        let ways = [
            (term, a, b, 2),
            (term, b, a, 2),
            (a, b, term, 1),
            (b, a, term, 1),
            (a, term, b, 0),
            (b, term, a, 0),
        ];
        let last_use = |emitter: &Emitter, id: Id| {
            // This instruction contains the last uses.
            let own = [a, b, term]
                .into_iter()
                .filter(|other| *other == id)
                .count() as u32;
            emitter.next_use[id as usize] + own >= emitter.first_use[id as usize + 1]
        };
        let price = |emitter: &Emitter, &(over, second, third, _): &(Id, Id, Id, usize)| {
            let held = |id: Id| emitter.register_of[id as usize].is_some();
            let copy = u32::from(!(held(over) && last_use(emitter, over)));
            let load = u32::from(!held(second) && second != over);
            // Copying a register while another operand is in memory is wasteful: that operand could be loaded and overwritten instead.
            let waste = u32::from(held(over) && copy == 1 && !held(third));
            2 * (copy + load) + waste
        };
        let best = ways.iter().min_by_key(|way| price(self, way));
        let (over, second, third, form) = *best.unwrap_or(&ways[0]);

        let registers =
            |emitter: &Emitter| [over, second, third].map(|id| emitter.register_of[id as usize]);
        let held = registers(self);
        let second = self.in_register(second, &held)?;
        let held = registers(self);
        let last = self.last(third, &held, false)?;
        let held = registers(self);
        let to = match self.register_of[over as usize] {
            Some(index) if last_use(self, over) => index,
            Some(index) => {
                let to = self.take(&held)?;
                let (into, from) = (self.register(to), self.register(index));
                self.put(Encoded::with2(self.table.copy, into, from)?)?;
                to
            }
            None => {
                let to = self.take(&held)?;
                if let Some(place) = self.home[over as usize] {
                    self.read(to, place)?;
                }
                to
            }
        };
        let kind = match kind {
            Contracted::Add => 0,
            Contracted::Sub => 1,
            Contracted::SubFrom => 2,
        };
        let code = self.table.fused[kind][form];
        let (into, second) = (self.register(to), self.register(second));
        self.put(match last {
            Last::Register(third) => Encoded::with3(code, into, second, self.register(third))?,
            Last::Memory(place) => Encoded::with3(code, into, second, place)?,
        })?;
        self.past(id);
        self.hold(to, id);
        self.done(id, to)
    }
}

/// The offset from the start of the workspace at which the address of an argument is stored, by the index of its [`Base`].
fn saved(base: usize) -> i64 {
    8 * base as i64
}

/// The last operand of an instruction, in a register or in memory.
#[derive(Clone, Copy)]
enum Last {
    Register(u8),
    Memory(MemoryOperand),
}
