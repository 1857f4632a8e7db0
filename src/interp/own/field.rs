//! Fields of one to three dimensions: `DEF REAL A[3,2]=SET(1,2,3)`. SET fills row by row and keeps what it leaves out, REP repeats one value
//! (Sinumerik 840D sl Programming Manual, Job Planning, fields). Fields of axes and frames are not followed; those of texts: [`super::strings`].
use super::{Own, Scope, Sort, arguments};

/// A longer field is not followed.
const MOST: usize = 1000;

/// See the module.
#[derive(Clone, Debug)]
pub(super) struct Field {
    sort: Sort,
    /// The number of elements in each dimension.
    sizes: Vec<usize>,
    elements: Vec<Option<f64>>,
}

impl Field {
    /// The known elements, by name.
    fn known<'a>(&'a self, stem: &'a str) -> impl Iterator<Item = (Box<str>, f64)> + 'a {
        let known = self.elements.iter().enumerate();
        known.filter_map(move |(index, value)| Some((format!("{stem}[{index}]").into(), (*value)?)))
    }
}

impl Own {
    /// `A[3]=SET(1,2,3)` after DEF; whether all its elements are known.
    pub(super) fn define_field(&mut self, sort: Sort, text: &str) -> bool {
        let (name, values) = match text.split_once('=') {
            Some((name, values)) => (name, Some(values)),
            None => (text, None),
        };
        let (stem, index) = name.split_once('[').unwrap_or((name, ""));
        let stem = stem.trim().to_ascii_lowercase();
        self.declare(&stem, Sort::Other, None);
        let sizes = index.trim().strip_suffix(']').map(arguments).unwrap_or_default();
        let size = |text: &&str| {
            let size = self.value(text).filter(|size| size.fract() == 0.0);
            size.filter(|size| (1.0..=MOST as f64).contains(size))
                .map(|size| size as usize)
        };
        let sizes: Option<Vec<usize>> = sizes.iter().map(size).collect();
        let sizes = sizes.filter(|sizes| (1..=3).contains(&sizes.len()) && sizes.iter().product::<usize>() <= MOST);
        let Some(sizes) = sizes.filter(|_| sort != Sort::Other) else {
            return false;
        };
        let elements = vec![Some(0.0); sizes.iter().product()];
        let field = Field { sort, sizes, elements };
        self.scope.fields.insert(stem.as_str().into(), field);
        if let Some(values) = values {
            self.fill(&stem, "0", values);
        }
        self.is_known_field(&stem)
    }

    /// An element gets a value; any may have it where the index is unknown.
    pub(super) fn assign_element(&mut self, stem: &str, index: &str, value: Option<f64>) {
        let stem = stem.trim();
        let place = index
            .trim_end()
            .strip_suffix(']')
            .and_then(|index| self.place_in(stem, &arguments(index), 0));
        let Some(field) = self.scope.fields.get_mut(stem) else {
            return;
        };
        match place.and_then(|place| field.elements.get_mut(usize::try_from(place).ok()?)) {
            Some(element) => *element = value.and_then(|value| field.sort.takes(value)),
            None => field.elements.fill(None),
        }
        self.fresh.push(stem.into());
    }

    /// `A[1]=SET(4,5)`: fills from an element on; false: it is another text.
    pub(super) fn assign_list(&mut self, name: &str, text: &str) -> bool {
        let Some((stem, index)) = name.split_once('[') else {
            return false;
        };
        let stem = stem.trim().to_ascii_lowercase();
        let is_list = list(text).is_some() && self.scope.fields.contains_key(stem.as_str());
        if is_list {
            self.changes += 1;
            self.fill(&stem, index.trim_end().trim_end_matches(']'), text);
        }
        is_list
    }

    fn fill(&mut self, stem: &str, index: &str, text: &str) {
        // `0` at the definition: from its first element on
        let from = match index {
            "0" => Some(0),
            index => self.place_in(stem, &arguments(index), 0),
        };
        let parts = list(text).map(|(repeats, inside)| (repeats, arguments(inside)));
        let filled = match (&parts, from) {
            (Some((repeats, parts)), Some(from)) => Some((*repeats, self.listed(*repeats, parts), from as usize)),
            _ => None,
        };
        self.fresh.push(stem.into());
        let Some(field) = self.scope.fields.get_mut(stem) else {
            return;
        };
        let count = field.elements.len();
        let takes = |value: Option<f64>| value.and_then(|value| field.sort.takes(value));
        match filled {
            Some((false, values, from)) if from + values.len() <= count => {
                for (element, value) in field.elements[from..].iter_mut().zip(values) {
                    if let (true, value) = value {
                        *element = takes(value);
                    }
                }
            }
            Some((true, values, from)) if values.len() == 1 && from < count => {
                let value = takes(values[0].1);
                field.elements[from..].fill(value);
            }
            // `REP(v,n)`: n elements
            Some((true, values, from)) if values.len() == 2 => {
                let times = values[1].1.filter(|times| times.fract() == 0.0 && *times >= 0.0);
                let times = times.map(|times| times as usize).filter(|times| from + times <= count);
                let value = takes(values[0].1);
                match times {
                    Some(times) => field.elements[from..from + times].fill(value),
                    None => field.elements.fill(None),
                }
            }
            _ => field.elements.fill(None),
        }
    }

    /// The values of a list, and whether anything is between its commas. The number of repetitions is the second of REP.
    fn listed(&self, repeats: bool, parts: &[&str]) -> Vec<(bool, Option<f64>)> {
        let most = if repeats { 2 } else { MOST };
        let value = |part: &&str| (!part.is_empty(), self.value(part));
        parts.iter().take(most + 1).map(value).collect()
    }

    /// The type of the elements of a field, and how many there are in each dimension.
    pub(super) fn form_of(&self, stem: &str) -> Option<(Sort, &[usize])> {
        let field = self.scope.fields.get(stem)?;
        Some((field.sort, &field.sizes))
    }

    /// Whether a field has one dimension.
    pub(super) fn is_one_row(&self, stem: &str) -> bool {
        self.scope.fields.get(stem).is_some_and(|field| field.sizes.len() == 1)
    }

    /// Where an element is in the order of a field, row by row.
    pub(super) fn place_in(&self, stem: &str, indices: &[&str], nested: u32) -> Option<i64> {
        let sizes = &self.scope.fields.get(stem)?.sizes;
        if sizes.len() != indices.len() {
            return None;
        }
        let mut place = 0usize;
        for (size, index) in sizes.iter().zip(indices) {
            let index = self
                .value_in(index, nested)
                .filter(|index| index.fract() == 0.0 && *index >= 0.0)?;
            let index = (index < *size as f64).then_some(index as usize)?;
            place = place * size + index;
        }
        i64::try_from(place).ok()
    }

    /// Whether every element of a field is known.
    pub(crate) fn is_known_field(&self, stem: &str) -> bool {
        let field = self.scope.fields.get(stem.trim().to_ascii_lowercase().as_str());
        field.is_some_and(|field| field.elements.iter().all(Option::is_some))
    }

    /// `stem` in lower case; `None` where it is unknown, or was written in the same block.
    pub(super) fn element(&self, stem: &str, index: i64) -> Option<f64> {
        let field = self.scope.fields.get(stem).filter(|_| !self.is_fresh(stem))?;
        *field.elements.get(usize::try_from(index).ok()?)?
    }

    /// The same by `name[index]` in lower case, also in the block that writes it.
    pub(super) fn held_element(&self, name: &str) -> Option<f64> {
        let (stem, index) = name.split_once('[')?;
        let place = self.place_in(stem, &arguments(index.strip_suffix(']')?), 0)?;
        *self
            .scope
            .fields
            .get(stem)?
            .elements
            .get(usize::try_from(place).ok()?)?
    }

    /// All that are known, by name.
    pub(super) fn elements(&self) -> impl Iterator<Item = (Box<str>, f64)> {
        self.scope.fields.iter().flat_map(|(stem, field)| field.known(stem))
    }

    /// The known elements of one field.
    pub(super) fn elements_of(&self, stem: &str) -> impl Iterator<Item = (Box<str>, f64)> {
        let found = self.scope.fields.get_key_value(stem).into_iter();
        found.flat_map(|(stem, field)| field.known(stem))
    }

    /// A field of the caller becomes a parameter: its name, its type and the number of elements in each dimension, `None` where PROC leaves
    /// it open. A field of another form is not followed.
    pub(crate) fn copy_field(
        &mut self,
        caller: &Scope,
        from: &str,
        (name, sort, sizes): (&str, Sort, &[Option<usize>]),
    ) {
        let is_this = |field: &&Field| {
            let same = field
                .sizes
                .iter()
                .zip(sizes)
                .all(|(size, wanted)| wanted.is_none_or(|wanted| wanted == *size));
            field.sort == sort && field.sizes.len() == sizes.len() && same
        };
        if let Some(field) = caller.fields.get(from).filter(is_this) {
            self.scope.fields.insert(name.into(), field.clone());
        }
    }

    /// A field that was a parameter with VAR goes back to the caller; false: it was none.
    pub(crate) fn copy_back(&mut self, used: &Scope, here: &str, there: &str) -> bool {
        let (Some(from), Some(to)) = (used.fields.get(here), self.scope.fields.get_mut(there)) else {
            return false;
        };
        to.elements.clone_from(&from.elements);
        self.changes += 1;
        self.fresh.push(there.into());
        true
    }

    pub(super) fn lose_fields(&mut self) {
        for field in self.scope.fields.values_mut() {
            field.elements.fill(None);
        }
    }
}

/// Whether a list repeats its value (REP), and the text between its parentheses; `None`: it is no list.
pub(super) fn list(text: &str) -> Option<(bool, &str)> {
    let (name, inside) = text.trim().split_once('(')?;
    let inside = inside.strip_suffix(')')?;
    match name.trim().to_ascii_uppercase().as_str() {
        "SET" => Some((false, inside)),
        "REP" => Some((true, inside)),
        _ => None,
    }
}

/// To the nearest whole number; which way a negative half goes is not documented.
pub(super) fn rounded(value: f64) -> Option<f64> {
    (value >= 0.0 || value.fract() != -0.5).then(|| (value + 0.5).floor())
}
