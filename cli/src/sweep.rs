//! `lagrangian sweep`: many runs of a machine.

mod design;
mod reductions;
mod reporter;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Instant;

use lagrangian::Method;
use lagrangian::interpreted::Engine;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_sweep::plan::{Function, Reduction, SpecText, VERSION, Watch};
use lagrangian_sweep::table::Format;
use lagrangian_sweep::{
    Folder, FolderError, Plan, PlanError, Summary, Sweep, chunk_length, cores, run_all,
    samples_beside,
};
use lagrangian_symbolic::Dag;
use serde_json::json;

use crate::call::{self, Assignment};
use crate::diagnostics;
use crate::failure::Failure;
use crate::heading;
use crate::inputs;
use crate::interrupt;
use crate::methods::{self, AUTO};
use crate::output::{self, Destination, TABLE, ending_is_one_of, keep_apart};
use crate::progress;
use crate::reading;
use crate::runs;
use crate::table;
use crate::text_table::TextTable;
use reporter::Reporter;

/// The destination of rows.
struct Out {
    /// The folder of chunks.
    folder: PathBuf,
    format: Format,
    /// The file to which chunks are joined, and its name in the call; `None` if chunks stay in the folder.
    file: Option<PathBuf>,
    shown: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// If the spec, the call or a file is invalid. Runs that fail are rows, and an error only with `--strict`.
pub fn run(call: &call::Sweep) -> Result<(), Failure> {
    let is_plan = call
        .spec
        .path
        .extension()
        .is_some_and(|ending| ending == "json");
    let plan = if is_plan {
        read_plan(call)?
    } else {
        plan(call)?
    };
    if call.chunk.is_some() && !is_plan {
        return Err(Failure::Call(
            "--chunk runs a part of a plan: write a plan by --plan PLAN.json, then `lagrangian sweep PLAN.json --chunk K`".into(),
        ));
    }
    let engine = match call.start.running.engine {
        call::Engine::Auto => Engine::Auto,
        call::Engine::Interpreter => Engine::Interpreter,
        call::Engine::Jit => Engine::Jit,
    };
    if let Some(path) = &call.plan {
        return write_plan(call, plan, engine, path);
    }
    let out = Out::of(call, &plan)?;
    // A plan that is refused leaves no folder behind.
    let mut sweep = prepare(plan.clone(), engine)?;
    let is_part = call.chunk.is_some();
    let folder = Folder::open(&out.folder, out.format, is_part).map_err(failure)?;
    let known = if call.fresh && !is_part {
        folder.clear().map_err(failure)?;
        None
    } else {
        folder.plan().map_err(failure)?
    };
    if let Some(known) = &known {
        check_same_plan(&plan, known, is_part, &out)?;
    }
    if let Some(chunk) = call.chunk {
        return one_chunk(&sweep, &folder, chunk, call.spec.json);
    }
    match &known {
        Some(known) => sweep.set_chunk(known.chunk),
        None => {
            if !is_plan {
                let length = chunk_length(&sweep);
                sweep.set_chunk(length);
            }
            folder.begin(sweep.plan()).map_err(failure)?;
        }
    }
    all(call, &sweep, folder, &out)
}

/// Writes the plan of a call to a file.
fn write_plan(call: &call::Sweep, plan: Plan, engine: Engine, path: &Path) -> Result<(), Failure> {
    let to = Destination::new("--plan", path, &["json"])?;
    keep_from(call, &plan, [&to])?;
    let sweep = prepare(plan, engine)?;
    let mut plan = sweep.plan().clone();
    plan.chunk = chunk_length(&sweep);
    to.write_text(&(plan.to_json() + "\n"))?;
    let (runs, chunks) = (plan.runs(), plan.chunks());
    if call.spec.json {
        let document =
            json!({ "runs": runs, "chunks": chunks, "plan": path.display().to_string() });
        output::line(format_args!("{document:#}"));
    } else {
        output::line(format_args!(
            "{runs} runs in {chunks} chunks of {}, {}",
            plan.chunk,
            path.display()
        ));
    }
    Ok(())
}

/// Checks that a folder with chunks of a plan has those of this one; the length of its chunks matters only if a part is run.
fn check_same_plan(plan: &Plan, known: &Plan, is_part: bool, out: &Out) -> Result<(), Failure> {
    let mut differences = plan.differences(known);
    if is_part && plan.chunk != known.chunk {
        differences.push(format!("chunk: {}, was {}", plan.chunk, known.chunk));
    }
    if differences.is_empty() {
        return Ok(());
    }
    let trouble = FolderError::OtherPlan(differences);
    Err(Failure::Call(format!(
        "{}: {trouble}",
        out.folder.display()
    )))
}

/// Makes the missing chunks, and joins them.
fn all(call: &call::Sweep, sweep: &Sweep, folder: Folder, out: &Out) -> Result<(), Failure> {
    let stop = interrupt::flag();
    let threads = call.threads.map_or_else(cores, |threads| {
        usize::try_from(threads).unwrap_or(usize::MAX)
    });
    let began = Instant::now();
    progress::end();
    let mut reporter = Reporter::new(sweep.plan().runs(), call.spec.json);
    let watch = &mut |now| reporter.report(now);
    let made = run_all(sweep, &folder, (threads, call.limit), &stop, watch);
    reporter.end();
    let going_on = "the same command resumes the sweep";
    let now = made.map_err(|trouble| {
        Failure::Run(format!(
            "cannot write {trouble}; what has been computed is kept, and {going_on}"
        ))
    })?;
    let seconds = began.elapsed().as_secs_f64();
    let runs = sweep.plan().runs();
    let is_all = (0..sweep.plan().chunks()).all(|chunk| folder.has_chunk(sweep, chunk));
    let shown = out.shown.display();
    if !is_all {
        let is_interrupted = stop.load(Ordering::Relaxed);
        let done = folder.runs(sweep);
        if call.spec.json {
            let document = json!({ "runs": done, "of": runs, "seconds": seconds, "out": shown.to_string(), "interrupted": is_interrupted });
            output::line(format_args!("{document:#}"));
        } else {
            output::line(format_args!(
                "{done} of {runs} runs are kept in {}; {going_on}",
                out.folder.display()
            ));
        }
        return if is_interrupted {
            Err(Failure::Interrupted)
        } else {
            Ok(())
        };
    }
    let summary = folder.summary(sweep).map_err(failure)?;
    if let Some(file) = &out.file {
        let joined = folder.join(sweep, file);
        joined.map_err(|trouble| {
            Failure::Run(format!(
                "cannot write {trouble}; what has been computed is kept, and {going_on}"
            ))
        })?;
        folder.remove().map_err(failure)?;
    }
    print_summary(call, &summary, (seconds, now), &shown.to_string());
    if call.strict && summary.failed > 0 {
        Err(Failure::AlreadyReported)
    } else {
        Ok(())
    }
}

/// A number of runs, in words.
fn counted(runs: u64) -> String {
    match runs {
        1 => "1 run".to_owned(),
        runs => format!("{runs} runs"),
    }
}

/// Prints a summary.
fn print_summary(call: &call::Sweep, summary: &Summary, (seconds, now): (f64, u64), shown: &str) {
    let Summary {
        runs,
        failed,
        first_errors,
        methods,
    } = summary;
    if call.spec.json {
        let errors = first_errors
            .iter()
            .map(|(run, error)| json!({ "run": run, "error": error }));
        let mut document = json!({
            "runs": runs,
            "failed": failed,
            "seconds": seconds,
            "out": shown,
            "first_errors": errors.collect::<Vec<_>>(),
        });
        if !methods.is_empty() {
            document["methods"] = json!(methods);
        }
        output::line(format_args!("{document:#}"));
        return;
    }
    let usual = <&Method>::default().tableau.name;
    let speed = now as f64 / seconds.max(1e-9);
    output::line(format_args!(
        "{}, {failed} failed, {seconds:.1} s ({speed:.0} runs per second), {shown}",
        counted(*runs)
    ));
    // If all runs went by the usual method, the choice is not mentioned, as by `simulate`.
    if methods.keys().any(|names| names != usual) {
        for (names, runs) in methods {
            output::line(format_args!("  {names}: {}", counted(*runs)));
        }
    }
    for (run, error) in first_errors {
        output::line(format_args!("  run {run}: {error}"));
    }
}

/// Makes one chunk of a plan.
fn one_chunk(sweep: &Sweep, folder: &Folder, chunk: u64, json: bool) -> Result<(), Failure> {
    let chunks = sweep.plan().chunks();
    if chunk >= chunks {
        return Err(Failure::Call(format!(
            "--chunk {chunk}: the plan has chunks 0 to {}",
            chunks - 1
        )));
    }
    folder.begin_shared(sweep.plan()).map_err(failure)?;
    let stop = interrupt::flag();
    if folder.has_chunk(sweep, chunk) {
        return Ok(());
    }
    let Some(made) = sweep.run_chunk(chunk, &stop) else {
        return Err(Failure::Interrupted);
    };
    folder.store(chunk, &made).map_err(failure)?;
    let runs = made.rows.len();
    if json {
        let document = json!({ "chunk": chunk, "runs": runs, "failed": made.failed });
        output::line(format_args!("{document:#}"));
    } else {
        output::line(format_args!(
            "chunk {chunk}: {runs} runs, {} failed",
            made.failed
        ))
    }
    Ok(())
}

impl Out {
    fn of(call: &call::Sweep, plan: &Plan) -> Result<Out, Failure> {
        let Some(path) = &call.out else {
            return Err(Failure::Call(
                "give the destination of the rows: --out FILE.csv, FILE.parquet or FOLDER".into(),
            ));
        };
        let is_folder = path.as_os_str().as_encoded_bytes().ends_with(b"/") || path.is_dir();
        if is_folder || (path.extension().is_none() && !path.exists()) {
            return Ok(Out {
                folder: path.clone(),
                format: if Format::Parquet.is_available() {
                    Format::Parquet
                } else {
                    Format::Csv
                },
                file: None,
                shown: path.clone(),
            });
        }
        if !ending_is_one_of(path, TABLE) {
            return Err(Failure::Call(format!(
                "--out {}: rows go to a `.csv`, a `.parquet` or a folder; the name of a new folder with a dot in it ends with `/`",
                path.display()
            )));
        }
        let to = Destination::new("--out", path, TABLE)?;
        let samples = if plan.has_samples() {
            Some(Destination::new("--out", &samples_beside(path), TABLE)?)
        } else {
            None
        };
        keep_from(call, plan, [&to].into_iter().chain(&samples))?;
        let Some(file) = to.file() else {
            return Err(Failure::Call(format!(
                "--out {}: rows are joined from chunks beside the file, which is impossible for a device",
                path.display()
            )));
        };
        let mut folder = file.as_os_str().to_owned();
        folder.push(".part");
        Ok(Out {
            folder: PathBuf::from(folder),
            format: match to.ending() {
                "parquet" => Format::Parquet,
                _ => Format::Csv,
            },
            file: Some(file.to_owned()),
            shown: path.clone(),
        })
    }
}

/// Refuses to write a file from which the sweep is made: its spec, one that it extends, or a table.
fn keep_from<'a>(
    call: &call::Sweep,
    plan: &Plan,
    destinations: impl IntoIterator<Item = &'a Destination>,
) -> Result<(), Failure> {
    let bases = plan.spec.files.iter().map(|file| Path::new(&file.name));
    let mut read: Vec<(&Path, &str)> = vec![(&call.spec.path, "the spec")];
    read.extend(bases.map(|path| (path, reading::read_as(path))));
    read.extend(
        call.table
            .iter()
            .map(|path| (path.as_path(), "the table of runs")),
    );
    let written = inputs::parse(&call.inputs)?;
    read.extend(inputs::files(&written));
    keep_apart(destinations, &read)
}

/// Prepares a plan.
fn prepare(plan: Plan, engine: Engine) -> Result<Sweep, Failure> {
    let sweep = Sweep::new(plan, engine).map_err(|wrong| match wrong {
        PlanError::Plan(message) => Failure::Call(message),
        PlanError::Spec(wrong) => {
            let (report, sources) = *wrong;
            inputs::formula(&report, &sources)
                .unwrap_or_else(|| Failure::Spec(Box::new((report, sources))))
        }
    })?;
    if let Some(warning) = sweep.warning() {
        output::print_error(format_args!("warning: {warning}"));
    }
    Ok(sweep)
}

fn failure(trouble: FolderError) -> Failure {
    let message = trouble.to_string();
    match trouble {
        FolderError::OtherFiles(..) => Failure::Call(format!("--out: {message}")),
        _ => Failure::Run(message),
    }
}

/// Reads the plan from a file.
fn read_plan(call: &call::Sweep) -> Result<Plan, Failure> {
    let path = &call.spec.path;
    let shown = path.display();
    let is_said = call.until.is_some()
        || !call.vary.is_empty()
        || !call.reductions.is_empty()
        || !call.record.is_empty()
        || !call.start.parameters.is_empty()
        || !call.start.coordinates.is_empty()
        || !call.start.rates.is_empty()
        || !call.inputs.is_empty()
        || !call.events.is_empty()
        || !call.ends.is_empty()
        || !call.spec.constants.is_empty()
        || call.table.is_some()
        || call.samples.is_some()
        || call.after.is_some()
        || call.seed.is_some()
        || call.design.is_some()
        || call.tolerance.is_some()
        || call.method.is_some()
        || call.max_steps.is_some()
        || !call.keep.names.is_empty()
        || !call.together.is_empty()
        || call.plan.is_some();
    if is_said {
        return Err(Failure::Call(format!(
            "{shown} is a plan, which itself specifies what is run: only --out, --chunk, --limit, --threads, --fresh, --engine, --strict and \
             --json can be used with it"
        )));
    }
    let text = std::fs::read_to_string(path)
        .map_err(|error| Failure::Call(format!("cannot read {shown}: {error}")))?;
    Plan::from_json(&text).map_err(|why| Failure::Call(format!("{shown} is not a plan: {why}")))
}

/// Refuses `first(x)` and `last(x)` where `x` is an event and a quantity as well.
fn check_events(reduce: &[Reduction], model: &Model<'_>) -> Result<(), Failure> {
    let coordinates = model.coordinates.iter().map(|q| q.name.to_string());
    let parameters = model.parameters.iter().map(|of| of.name.to_string());
    let inputs = model.inputs.iter().map(|of| of.name.to_string());
    let outputs = model.outputs.iter().map(|output| output.name.to_string());
    let names = coordinates.chain(parameters).chain(inputs).chain(outputs);
    let quantities: BTreeSet<String> = names.chain(["t".to_owned()]).collect();
    let mut of_events = reduce
        .iter()
        .filter(|one| matches!(one.function, Function::FirstEvent | Function::LastEvent));
    match of_events.find(|one| quantities.contains(&one.of)) {
        Some(Reduction { name, of, .. }) => Err(Failure::Call(format!(
            "--reduce {name}: `{of}` is an event and also a quantity of the machine: give the event another name"
        ))),
        None => Ok(()),
    }
}

/// The plan that a call describes.
fn plan(call: &call::Sweep) -> Result<Plan, Failure> {
    let Some(until) = call.until else {
        return Err(Failure::Call(
            "give the end of each run: --until SECONDS".into(),
        ));
    };
    let method = call.method.as_deref().unwrap_or(AUTO);
    if method != AUTO {
        methods::named_beside(method, &[AUTO])?;
    }
    let dag = Dag::new();
    let (spec, model) = read_spec(call, &dag)?;
    let start = &call.start;
    let set = values(&model, ("--set", &start.parameters), str::to_owned)?;
    let starts = values(&model, ("--start", &start.coordinates), |name| {
        format!("start({name})")
    })?;
    let rates = values(&model, ("--rate", &start.rates), |name| {
        format!("rate({name})")
    })?;
    let keep = reading::kept_names(&call.keep).map(<[String]>::to_vec);
    if keep.is_some() {
        check_kept(&model, &call.keep)?;
    }
    let events = watches(call);
    let recorded = reductions::recorded(&call.record)?;
    if call.after.is_some() && call.reductions.is_empty() && recorded.events.is_empty() {
        return Err(Failure::Call(
            "--after applies to --reduce and to --record event=NAME, and there are none".into(),
        ));
    }
    let reduce = reductions::reductions(&call.reductions, &events)?;
    check_events(&reduce, &model)?;
    Ok(Plan {
        version: VERSION,
        spec,
        set,
        start: starts,
        rate: rates,
        keep,
        until,
        tolerance: call.tolerance.unwrap_or(runs::TOLERANCE),
        method: method.to_owned(),
        max_steps: call.max_steps.unwrap_or(runs::STEPS) as u64,
        inputs: inputs::laws(&inputs::parse(&call.inputs)?, &model)?,
        reduce,
        events,
        at: recorded.at,
        every: recorded.every,
        at_events: recorded.events,
        after: call.after,
        design: design::factors(call, &model)?,
        chunk: 1,
    })
}

/// The texts of the spec of a call, as its plan keeps them, and its model.
fn read_spec<'d>(call: &call::Sweep, dag: &'d Dag) -> Result<(SpecText, Model<'d>), Failure> {
    let path = call.spec.path.to_string_lossy();
    let (_, text) = Disk
        .read(&path, None)
        .map_err(|error| Failure::Call(format!("cannot read {path}: {error}")))?;
    let (mut sources, mut report) = (Sources::new(), Report::new());
    let mut disk = Disk;
    let mut files = lagrangian_sweep::plan::FileRecorder::new(&mut disk);
    let constants = &call.spec.constants;
    let spec = lagrangian_spec::parse(&mut sources, &path, &text, &mut report);
    let model = Model::resolve(
        spec.with_given(call.spec.given.iter().cloned()),
        dag,
        constants,
        &mut files,
        &mut sources,
        &mut report,
    );
    let read = files.read;
    let Some(model) = model else {
        return Err(Failure::Spec(Box::new((report, sources))));
    };
    diagnostics::print(&report, &sources);
    let constants = constants
        .iter()
        .map(|(name, value)| (name.clone(), value.to_string()));
    let spec = SpecText {
        name: path.clone().into_owned(),
        text,
        files: read,
        constants: constants.collect(),
        given: Vec::new(),
    };
    Ok((spec, model))
}

/// The values that an option sets, in the units of what they belong to: `varied` is its name in `--vary`.
fn values(
    model: &Model<'_>,
    (option, list): (&str, &[Assignment]),
    varied: impl Fn(&str) -> String,
) -> Result<Vec<(String, f64)>, Failure> {
    let value = |set: &Assignment| {
        let unit = lagrangian_sweep::unit_of(model, &varied(&set.name))
            .map_err(|why| Failure::Call(format!("{option} {}: {why}", set.name)))?;
        let value = set.value(option, &unit).map_err(Failure::Call)?;
        Ok((set.name.clone(), value))
    };
    list.iter().map(value).collect()
}

/// The events of a call, and those that end runs.
fn watches(call: &call::Sweep) -> Vec<Watch> {
    let lists = [(&call.events, false), (&call.ends, true)];
    let events = lists.into_iter().flat_map(|(list, ends)| {
        list.iter().map(move |event| Watch {
            name: event.name.clone(),
            formula: event.value.clone(),
            ends,
        })
    });
    events.collect()
}

/// Checks that the numbers that `--keep` names exist.
fn check_kept(model: &Model<'_>, keep: &call::Keep) -> Result<(), Failure> {
    reading::check_kept_once(keep)?;
    for name in reading::kept_names(keep).unwrap_or_default() {
        let rate = name.strip_prefix("der(");
        let coordinate = rate.and_then(|rate| rate.strip_suffix(')')).unwrap_or(name);
        lagrangian_sweep::unit_of(model, &format!("start({coordinate})"))
            .map_err(|why| Failure::Call(format!("--keep {name}: {why}")))?;
    }
    Ok(())
}

/// A column of a table of runs: its name, and the unit in its header if there is one.
type Heading = (String, Option<String>);

/// The columns of numbers in a table of runs, with its rows.
fn numbers(path: &Path) -> Result<(Vec<Heading>, Vec<Vec<f64>>), Failure> {
    let wrong = |why: String| Failure::Call(format!("--table {}: {why}", path.display()));
    let split = |header: &str| {
        let (name, unit) = heading::name_and_unit(header);
        (name.to_owned(), unit.map(str::to_owned))
    };
    if path.extension().is_some_and(|ending| ending == "parquet") {
        let (headers, rows) =
            lagrangian_sweep::table::numbers(path).map_err(|error| wrong(error.to_string()))?;
        return Ok((headers.iter().map(|header| split(header)).collect(), rows));
    }
    let text = std::fs::read_to_string(path).map_err(|error| wrong(error.to_string()))?;
    let headers = TextTable::new(&text).headers;
    if headers.iter().all(|header| header.is_empty()) {
        return Err(wrong(
            "it is empty; its first line must name its columns".into(),
        ));
    }
    let headings: Vec<Heading> = headers.iter().map(|header| split(header)).collect();
    let names: Vec<String> = headings.iter().map(|(name, _)| name.clone()).collect();
    let rows = table::rows(&text, &names).map_err(wrong)?;
    Ok((headings, rows))
}
