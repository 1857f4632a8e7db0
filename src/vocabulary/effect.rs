//! What a program does apart from its motions: what it switches, requests, stores and waits for.
//!
//! A [`crate::Motion`] holds geometry, feed, tool and offsets. Everything else that a block requests is an [`Effect`]. What the interpreter
//! does not model is an effect too, with its words, so that a comparison of two programs misses nothing.
use std::borrow::Cow;

/// The value of an argument.
#[derive(Clone, Debug)]
pub enum Value {
    /// No value: a code, a name.
    Nothing,
    /// A number as the control reads it, evaluated. Lengths in programmed units. Never NaN.
    Number(f64),
    /// Text that has no known number: a name, or an expression whose value is unknown, with the known variables in it replaced.
    Text(Box<str>),
}

/// Two numbers are the same setting: equal to a relative 1e-9 (the contract for `certify` and `diff`, interface section 8.3).
pub fn same_number(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= 1e-9 * a.abs().max(b.abs())
}

impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Nothing, Self::Nothing) => true,
            (Self::Number(a), Self::Number(b)) => same_number(*a, *b),
            (Self::Text(a), Self::Text(b)) => a == b,
            _ => false,
        }
    }
}

/// One word of an effect: an address or name with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// Upper case: `M62`, `P`, `ADIS`, `#500`.
    pub name: Cow<'static, str>,
    /// Its value.
    pub value: Value,
}

impl Argument {
    /// A code or name without a value.
    pub fn code(name: impl Into<Cow<'static, str>>) -> Self {
        Self {
            name: name.into(),
            value: Value::Nothing,
        }
    }
    /// A word with a number. A value that is not a number becomes the text `unknown`.
    pub fn number(name: impl Into<Cow<'static, str>>, value: f64) -> Self {
        let value = if value.is_nan() {
            Value::Text("unknown".into())
        } else {
            Value::Number(value)
        };
        Self {
            name: name.into(),
            value,
        }
    }
    /// A word with a text.
    pub fn text(name: impl Into<Cow<'static, str>>, value: &str) -> Self {
        Self {
            name: name.into(),
            value: Value::Text(value.into()),
        }
    }
}

impl core::fmt::Display for Argument {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.name)?;
        let assigns = self.name.len() > 1;
        match &self.value {
            Value::Nothing => Ok(()),
            Value::Number(value) if assigns => write!(f, "={value}"),
            Value::Number(value) => write!(f, "{value}"),
            Value::Text(text) if assigns && !self.name.starts_with(['G', 'M']) => {
                write!(f, "={text}")
            }
            Value::Text(text) => f.write_str(text),
        }
    }
}

/// One thing that a program does apart from its motions.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// From here on a setting has this value. Setting it again to the same value changes nothing.
    Set {
        /// What is set: `spindle`, `speed`, `flood`, or the name of a modal group.
        key: Cow<'static, str>,
        /// Its value; empty: the initial value.
        to: Vec<Argument>,
    },
    /// Happens once, here: a stop, an output, data written to the control.
    Event(Vec<Argument>),
    /// A variable that keeps its value after the program ends receives one.
    Store(Argument),
    /// The program ends: the code that ends it.
    End(Vec<Argument>),
    /// A block that does more than is modelled, or whose values are unknown: its words.
    Unmodelled(Vec<Argument>),
}

impl Effect {
    /// A setting that receives a value.
    pub fn set(key: impl Into<Cow<'static, str>>, to: impl Into<Vec<Argument>>) -> Self {
        Self::Set {
            key: key.into(),
            to: to.into(),
        }
    }

    /// A setting that was on may end here: the machine decides. One that is off stays off.
    pub fn left(key: impl Into<Cow<'static, str>>) -> Self {
        Self::set(key, [Argument::code(LEFT)])
    }
}

/// See [`Effect::left`].
const LEFT: &str = "as the machine leaves it";

/// Whether a setting has the value of [`Effect::left`].
pub fn is_left(to: &[Argument]) -> bool {
    matches!(to, [only] if only.name == LEFT)
}

/// What an effect may change in addition to what it names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Nothing.
    Itself,
    /// The position of the machine, or its coordinate system.
    Place,
    /// It runs a user's program, which may read and change the modal state.
    Everything,
}

impl Effect {
    /// What an effect may change where its code does not say otherwise: a setting and a stored value change nothing else.
    pub fn usual_reach(&self) -> Reach {
        match self {
            Self::Set { .. } | Self::Store(_) | Self::End(_) => Reach::Itself,
            Self::Event(_) | Self::Unmodelled(_) => Reach::Place,
        }
    }
}

/// An effect and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The block: of the main program, as in [`crate::Motion::block`].
    pub block: trunnion_syntax::BlockId,
    /// What happens.
    pub effect: Effect,
    /// What it may change.
    pub reach: Reach,
}
