//! The native half of the Python package, which derives, evaluates and runs specs; `lagrangian/` contains the Python interface.

mod command;
mod errors;
mod evaluate;
mod inputs;
mod linear;
mod machine;
mod program;
mod run;
mod sensitive;
mod simulate;
mod sweep;
mod symbolic;

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<program::Program>()?;
    module.add_class::<machine::Machine>()?;
    module.add_class::<run::Run>()?;
    module.add_function(wrap_pyfunction!(program::derive, module)?)?;
    module.add_function(wrap_pyfunction!(program::rebuild, module)?)?;
    module.add_function(wrap_pyfunction!(sensitive::sensitivities, module)?)?;
    module.add_function(wrap_pyfunction!(symbolic::symbolic, module)?)?;
    module.add_function(wrap_pyfunction!(command::command, module)?)?;
    module.add_function(wrap_pyfunction!(command::answer, module)?)?;
    module.add_function(wrap_pyfunction!(command::answer_of_file, module)?)?;
    module.add_function(wrap_pyfunction!(machine::set_engine, module)?)?;
    module.add_function(wrap_pyfunction!(machine::engine, module)?)?;
    module.add_function(wrap_pyfunction!(evaluate::set_threads, module)?)?;
    module.add_function(wrap_pyfunction!(evaluate::accelerations, module)?)?;
    module.add_function(wrap_pyfunction!(evaluate::evaluate, module)?)?;
    module.add_function(wrap_pyfunction!(evaluate::linearize, module)?)?;
    module.add_function(wrap_pyfunction!(inputs::written, module)?)?;
    module.add_function(wrap_pyfunction!(linear::modes, module)?)?;
    module.add_function(wrap_pyfunction!(linear::linear_model, module)?)?;
    module.add_function(wrap_pyfunction!(simulate::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(simulate::methods, module)?)?;
    module.add_class::<sweep::Stop>()?;
    module.add_class::<sweep::Kept>()?;
    module.add_function(wrap_pyfunction!(sweep::chunk_file, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::plan, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::run_chunk, module)?)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))
}
