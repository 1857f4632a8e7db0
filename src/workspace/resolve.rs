//! Which settings, machine and dialect a program is checked with, and why.
use crate::{
    FoundMachine, LoadError, Subprograms, Texts,
    machine::{find_in, machine_of_comment},
    obstacles,
    settings::{config_for, folder_of, with_settings},
};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use trunnion_check::config::{FixSettings, FormatSettings, parse_tool_flag};
use trunnion_check::{Assume, Config, RuleLevel, Settings, did_you_mean, or_known, rule_names};
use trunnion_dialect::{Detected, Dialect, Foreign, Modeline, Surroundings};
use trunnion_interp::{ControlData, Files, Library, Limits, Setup};
use trunnion_machine::Machine;

/// Options of the user: they override the files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overrides {
    /// Embedded machine or TOML file.
    pub machine: Option<String>,
    /// Dialect.
    pub dialect: Option<String>,
    /// Settings file instead of the one found upward.
    pub config: Option<PathBuf>,
    /// `ball:10`.
    pub tool: Option<String>,
    /// Rules to silence.
    pub allow: Vec<String>,
    /// Dialects of the controls that the program is meant to run on too (`--port-to`), in addition to those of the settings.
    pub port_to: Vec<String>,
    /// Whether blocks that begin with `/` are skipped (`--block-delete`).
    pub block_delete: Option<bool>,
    /// What is taken as zero although it is not declared (`--assume`), in addition to the settings.
    pub assume: Vec<String>,
    /// Texts of settings, machine files, dialect tables and called programs that take the place of files, by their paths: for a caller without a disk.
    pub texts: Texts,
}

/// Everything a check needs in addition to the program.
#[derive(Clone)]
pub struct Resolved {
    /// Dialect.
    pub dialect: &'static Dialect,
    /// Why this dialect.
    pub dialect_reason: String,
    /// The reason leaves little doubt, or the dialect was named.
    pub dialect_certain: bool,
    /// The text is for an unsupported control, or is not a program.
    pub foreign: Option<Foreign>,
    /// Machine with the settings' tolerances applied.
    pub machine: Option<Machine>,
    /// Why this machine.
    pub machine_reason: String,
    /// The settings file that was read.
    pub config_path: Option<PathBuf>,
    /// The files that were read in addition to the program: settings, machine, dialect table.
    pub files: Vec<PathBuf>,
    /// Tools and work offsets.
    pub setup: Setup,
    /// Rule levels, last wins.
    pub rules: Vec<(String, RuleLevel)>,
    /// Dialects that the program is to be ported to.
    pub port_to: Vec<String>,
    /// What is taken as zero although it is not declared.
    pub assume: Assume,
    /// How the program is laid out.
    pub format: FormatSettings,
    /// What rewrites may do.
    pub fix: FixSettings,
    /// Where called programs are looked for.
    pub(crate) subprograms: Option<Arc<Subprograms>>,
}

impl Resolved {
    /// Whether a run looked for a program in another file: then its result depends on the folders that were searched.
    pub fn looked_for_subprograms(&self) -> bool {
        self.subprograms.as_ref().is_some_and(|found| found.looked())
    }
    /// The name of the dialect, or of the control that is not supported; none for a file that is not a program.
    pub fn dialect_name(&self) -> Option<&str> {
        match self.foreign {
            Some(Foreign::Control(control)) => Some(control.name),
            Some(Foreign::NotAProgram(_)) => None,
            None => Some(&self.dialect.name),
        }
    }
    /// Sets the bounds of a run.
    pub fn bound(&mut self, limits: Limits) {
        self.setup.limits = limits;
        if let Some(machine) = &mut self.machine {
            machine.most_turned = limits.turned();
        }
    }
    /// Those of a run in which every step is compared, proved, listed or drawn.
    pub fn bound_steps(&mut self) {
        self.bound(self.setup.limits.of_steps());
    }
    /// In the form of the check floor.
    pub fn settings(&self) -> Settings<'_> {
        Settings {
            dialect: self.dialect,
            machine: self.machine.as_ref(),
            setup: self.setup.clone(),
            rules: self.rules.clone(),
            port_to: self.port_to.clone(),
            scope: None,
            control_known: self.dialect_certain || self.dialect.name != "iso-6983",
            foreign: self.foreign,
            assume: self.assume,
        }
    }
}

/// Resolves for a program at `path` (`None`: standard input or an unsaved buffer) with the given text.
///
/// Machine: overrides, modeline comment, `trunnion.toml`. Dialect: overrides, modeline comment, `trunnion.toml`, then typical words in the
/// text, a file extension that only one control uses, and the machine's control family.
///
/// # Errors
/// A file that cannot be read or is not valid, an unknown name; each with its place.
pub fn resolve(path: Option<&Path>, source: &[u8], overrides: &Overrides) -> Result<Resolved, LoadError> {
    let (config, config_file) = config_for(path, overrides)?;
    let config = &*config;
    let config_path = config_file.as_ref().map(|(path, _)| path.clone());
    let mode = trunnion_dialect::modeline(source);
    let (machine, machine_reason) = machine_for(path, overrides, &mode, config, config_file.as_ref())?;
    offsets_fit(config, config_file.as_ref(), machine.as_ref())?;
    let (machine, machine_file) = machine.map_or((None, None), |found| (Some(found.machine), found.file));
    let file_name = path.and_then(Path::file_name).and_then(|name| name.to_str());
    let (detected, dialect_file) = dialect_for(
        overrides,
        &mode,
        (config, config_file.as_ref()),
        file_name,
        source,
        machine.as_ref(),
    )?;
    let mut rules = config.rules.clone();
    for rule in &overrides.allow {
        if trunnion_check::rule(rule).is_none() {
            let hint = did_you_mean(rule, &rule_names(), "; `trunnion rules` lists all rules");
            return Err(LoadError::new(format!("--allow {rule}: unknown rule{hint}")));
        }
        rules.push((rule.clone(), RuleLevel::Allow));
    }
    let mut setup = config.setup.clone();
    if let Some(flag) = &overrides.tool {
        setup
            .tools
            .push(parse_tool_flag(flag).map_err(|error| LoadError::new(format!("--tool {flag}: {error}")))?);
    }
    setup.control.block_delete = overrides.block_delete.or(setup.control.block_delete);
    if let Some(machine) = &machine {
        declared_by(machine, &mut setup.control);
    }
    let declared = setup.control.tcp_codes.take();
    Machine::tell(machine.as_ref(), &mut setup.control);
    setup.control.tcp_codes = declared.or(setup.control.tcp_codes);
    let subprograms = subprograms(path, config, config_file.as_ref(), &overrides.texts)?;
    setup.library = Library(subprograms.clone().map(|found| found as Arc<dyn Files>));
    let mut port_to = config.port_to.clone();
    for name in &overrides.port_to {
        if trunnion_dialect::builtin(name).is_none() {
            let hint = trunnion_dialect::dialect_hint(name);
            return Err(LoadError::new(format!("--port-to {name}: unknown dialect{hint}")));
        }
        port_to.push(name.clone());
    }
    let mut assume = config.assume;
    for name in &overrides.assume {
        if !assume.add(name) {
            let hint = or_known(name, &Assume::NAMES, "names");
            return Err(LoadError::new(format!("--assume {name}: this cannot be assumed{hint}")));
        }
    }
    let settled = machine.map(|machine| with_settings(&machine, config, config_file.as_ref()));
    let mut machine = settled.transpose()?;
    if detected.foreign.is_none() {
        obstacles::declare(path, source, detected.dialect, machine.as_mut())?;
    }
    Ok(Resolved {
        dialect: detected.dialect,
        dialect_reason: detected.reason,
        dialect_certain: detected.certain,
        foreign: detected.foreign,
        machine,
        machine_reason,
        files: [config_path.clone(), machine_file, dialect_file]
            .into_iter()
            .flatten()
            .collect(),
        config_path,
        setup,
        rules,
        port_to,
        assume,
        format: config.format,
        fix: config.fix,
        subprograms,
    })
}

/// What the machine file declares about its control applies where the settings declare nothing.
fn declared_by(machine: &Machine, control: &mut ControlData) {
    let of = &machine.control;
    control.units = control.units.or(of.units);
    control.peck_clearance_mm = control.peck_clearance_mm.or(of.peck_clearance_mm);
    control.chip_break_retract_mm = control.chip_break_retract_mm.or(of.chip_break_retract_mm);
    control.main_spindle = control.main_spindle.or(of.main_spindle);
    control.drilling_axis = control.drilling_axis.or(of.drilling_axis);
    control.roughing_escape = control.roughing_escape.or(of.roughing_escape);
    control.thread_pull_out = control.thread_pull_out.or(of.thread_pull_out);
    control.roughing_retract_mm = control.roughing_retract_mm.or(of.roughing_retract_mm);
    control.thread_least_cut_mm = control.thread_least_cut_mm.or(of.thread_least_cut_mm);
    control.thread_finish_mm = control.thread_finish_mm.or(of.thread_finish_mm);
    control.spline_arcs_mm = control.spline_arcs_mm.or(of.spline_arcs_mm);
    if let (true, Some(points)) = (control.reference_points.is_empty(), &of.reference_points) {
        control.reference_points.clone_from(points);
    }
    if control.fixed_points.is_none() {
        control.fixed_points.clone_from(&of.fixed_points);
    }
    if control.power_on.is_none() {
        control.power_on.clone_from(&of.power_on);
    }
}

/// Where programs that this one calls are searched: texts that were given, its own folder, then those of the settings, relative to the settings' file.
fn subprograms(
    path: Option<&Path>,
    config: &Config,
    config_file: Option<&(PathBuf, String)>,
    texts: &Texts,
) -> Result<Option<Arc<Subprograms>>, LoadError> {
    let mut folders = Vec::new();
    // a document that is not saved has a name, but no folder
    if let Some(file) = path.filter(|path| path.is_file()) {
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
        folders.push(folder.unwrap_or(Path::new(".")).to_owned());
    }
    if let Some((file, text)) = config_file {
        let home = file.parent().unwrap_or(Path::new(""));
        for (folder, span) in &config.subprogram_path {
            let folder = home.join(folder);
            if !folder.is_dir() {
                let message = format!("folder {} does not exist", folder.display());
                return Err(LoadError::at(file, text, Some(span), message));
            }
            folders.push(folder);
        }
    }
    if folders.is_empty() && texts.0.is_empty() {
        return Ok(None);
    }
    Ok(Some(Arc::new(Subprograms::new(folders).with_texts(texts))))
}

/// Whether the work offsets of the settings give each linear axis of the machine.
fn offsets_fit(
    config: &Config,
    config_file: Option<&(PathBuf, String)>,
    machine: Option<&FoundMachine>,
) -> Result<(), LoadError> {
    let (Some(found), Some((file, text))) = (machine, config_file) else {
        return Ok(());
    };
    config
        .check_offsets(&found.machine)
        .map_err(|error| LoadError::at(file, text, error.span.as_ref(), &error.message))
}

fn machine_for(
    path: Option<&Path>,
    overrides: &Overrides,
    mode: &Modeline,
    config: &Config,
    config_file: Option<&(PathBuf, String)>,
) -> Result<(Option<FoundMachine>, String), LoadError> {
    if let Some(name) = &overrides.machine {
        return Ok((Some(find_in(name, None, &overrides.texts)?), "named by the user".into()));
    }
    if let Some(name) = &mode.machine {
        let home = config_file.and_then(|(file, _)| file.parent()).unwrap_or(Path::new(""));
        let machine_path: Vec<PathBuf> = config
            .machine_path
            .iter()
            .map(|(folder, _)| home.join(folder))
            .collect();
        let folder = folder_of(path).unwrap_or_default();
        let machine = machine_of_comment(name, &folder, &machine_path).map_err(|error| match path {
            Some(path) if error.place.is_empty() => LoadError {
                place: format!("{}:{}", path.display(), mode.machine_line),
                ..error
            },
            _ => error,
        })?;
        return Ok((Some(machine), "modeline comment in the program".into()));
    }
    if let Some(name) = &config.machine {
        let folder = config_file.and_then(|(path, _)| path.parent());
        let machine = find_in(name, folder, &overrides.texts)
            .map_err(|error| crate::machine::in_settings(error, name, config_file))?;
        if let (Err(error), Some((path, text))) = (config.check_axes(&machine.machine), config_file) {
            return Err(LoadError::at(path, text, error.span.as_ref(), &error.message));
        }
        return Ok((Some(machine), "trunnion.toml".into()));
    }
    Ok((None, "none is named".into()))
}

fn dialect_for(
    overrides: &Overrides,
    mode: &Modeline,
    (config, config_file): (&Config, Option<&(PathBuf, String)>),
    file_name: Option<&str>,
    source: &[u8],
    machine: Option<&Machine>,
) -> Result<(Detected, Option<PathBuf>), LoadError> {
    if let Some(detected) = trunnion_dialect::not_text(source) {
        return Ok((detected, None));
    }
    let choices = [
        (&overrides.dialect, "named by the user"),
        (&mode.dialect, "modeline comment in the program"),
        (&config.dialect, "trunnion.toml"),
    ];
    for (name, reason) in choices {
        let Some(name) = name else { continue };
        let Some(detected) = trunnion_dialect::declared(name, reason, source, file_name) else {
            let hint = trunnion_dialect::dialect_hint(name);
            return Err(LoadError::new(format!("unknown dialect `{name}` ({reason}){hint}")));
        };
        return Ok((detected, None));
    }
    if let (Some((name, span)), Some((file, text))) = (&config.dialect_table, config_file) {
        let path = file.parent().unwrap_or(Path::new("")).join(name);
        if !overrides.texts.has(&path) && !path.is_file() {
            let message = format!("file {} does not exist", path.display());
            return Err(LoadError::at(file, text, Some(span), message));
        }
        let dialect = crate::table::table(&path, &overrides.texts)?;
        let detected = Detected {
            dialect,
            reason: format!("the table {name} of trunnion.toml"),
            certain: true,
            foreign: None,
        };
        return Ok((detected, Some(path)));
    }
    let known = Surroundings {
        family: machine.map(|machine| machine.control.family.as_str()),
        turns: machine.map(turns),
        no_y: machine.is_some_and(|machine| {
            let has = |wanted: u8| machine.own_axes().any(|(_, axis)| axis.letter == wanted);
            has(b'X') && has(b'Z') && !has(b'Y')
        }),
    };
    Ok((trunnion_dialect::detect_on(file_name, source, known), None))
}

/// Whether the part can turn on a spindle of the machine: an axis is one, X words are diameters, or there is no Y.
fn turns(machine: &Machine) -> bool {
    let spins = |axis: &trunnion_machine::Axis| axis.extra.spindle || axis.extra.diameter;
    machine.axes.iter().any(spins) || machine.own_axes().all(|(_, axis)| axis.letter != b'Y')
}
