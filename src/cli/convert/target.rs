//! The target of a conversion: the arguments of `convert`, and of `fix --rewrite retarget`.
use crate::cli::{failure::Failure, load::Loaded};
use std::path::{Path, PathBuf};
use trunnion_check::did_you_mean;
use trunnion_convert::{BUILTIN_POSTS, Post, Target, builtin_post, load_post};
use trunnion_machine::Machine;
use trunnion_workspace::{LoadError, find_machine};

/// What is written, and for which machine.
#[derive(clap::Args)]
pub(crate) struct TargetArgs {
    /// The target: a dialect, or `apt`. Default: the control of the target machine.
    #[arg(long, value_name = "DIALECT|apt")]
    to: Option<String>,
    /// The target machine. Default: --machine, which is the machine that the program was written for.
    #[arg(long, value_name = "NAME|FILE")]
    to_machine: Option<String>,
    /// Your own post (TOML): number formats, header, footer and the codes of the machine.
    #[arg(long, value_name = "FILE")]
    post: Option<PathBuf>,
}

/// The target that the arguments name.
pub(crate) struct Chosen {
    /// Its machine.
    pub(crate) machine: Option<Machine>,
    post: Option<PostOf>,
}

enum PostOf {
    Own(Box<Post>),
    Builtin(&'static Post),
}

impl Chosen {
    /// For the converter.
    pub(crate) fn target(&self) -> Target<'_> {
        let post = match &self.post {
            None => return Target::Apt,
            Some(PostOf::Own(post)) => post,
            Some(PostOf::Builtin(post)) => *post,
        };
        Target::Code {
            post,
            machine: self.machine.as_ref(),
        }
    }
}

impl TargetArgs {
    /// Whether they name a target.
    pub(crate) fn is_named(&self) -> bool {
        self.to.is_some() || self.to_machine.is_some() || self.post.is_some()
    }

    /// Files that are read: none of them may be an output.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        let machine = self.to_machine.as_deref().map(Path::new);
        self.post.as_deref().into_iter().chain(machine)
    }

    /// Finds the machine and the post.
    pub(crate) fn choose(&self, loaded: &Loaded) -> Result<Chosen, Failure> {
        let machine = match &self.to_machine {
            Some(name) => Some(find_machine(name, None)?.machine),
            None => loaded.resolved.machine.clone(),
        };
        let post = match &self.post {
            Some(path) => Some(PostOf::Own(Box::new(self.own_post(path)?))),
            None => self.builtin_post(loaded, machine.as_ref())?.map(PostOf::Builtin),
        };
        Ok(Chosen { machine, post })
    }

    /// The user's own post, with the place of a mistake in it.
    fn own_post(&self, path: &Path) -> Result<Post, Failure> {
        let text = trunnion_files::read_settings(path)?;
        let post = load_post(&text).map_err(|error| LoadError::at(path, &text, error.span.as_ref(), &error.message))?;
        if self.to.as_ref().is_some_and(|name| *name != post.dialect) {
            return Err(Failure::new(format!(
                "the post is for {}, but --to names another dialect",
                post.dialect
            )));
        }
        Ok(post)
    }

    /// The embedded post of the target; `None`: it is written as APT.
    fn builtin_post(&self, loaded: &Loaded, machine: Option<&Machine>) -> Result<Option<&'static Post>, Failure> {
        let family = machine.map(|machine| machine.control.family.clone());
        let same = Some(loaded.resolved.dialect.name.clone()).filter(|name| name != "apt");
        let known = |name: &String| builtin_post(name).is_some();
        let name = match &self.to {
            Some(name) => name.clone(),
            None => family.filter(known).or(same.filter(known)).ok_or_else(|| {
                Failure::new(format!(
                    "the target is missing: add --to apt, or --to with one of {}",
                    BUILTIN_POSTS.join(", ")
                ))
            })?,
        };
        if name == "apt" {
            return Ok(None);
        }
        builtin_post(&name).map(Some).ok_or_else(|| {
            let all = format!(
                "; there are posts for {} and apt, or use your own (--post FILE)",
                BUILTIN_POSTS.join(", ")
            );
            Failure::new(format!(
                "no post for `{name}`{}",
                did_you_mean(&name, BUILTIN_POSTS, &all)
            ))
        })
    }
}
