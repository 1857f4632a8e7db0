//! The postures that a program takes, and whether no others cost less.
use crate::Outcome;
use crate::certificate::PostureCosts;
use crate::postures::{Graph, PostureCost, Stations};
use trunnion_geometry::rad;
use trunnion_machine::{Leg, Machine};

/// Postures before and after, motion by motion.
pub(crate) struct Chosen<'m> {
    machine: &'m Machine,
    stations: Stations<'m>,
    /// Rotary joints of each motion of the program after, rad; none where its end is unknown.
    after: Vec<Option<[f64; 2]>>,
}

impl<'m> Chosen<'m> {
    pub(crate) fn new(machine: &'m Machine) -> Self {
        Self {
            machine,
            stations: Stations::new(machine),
            after: Vec::new(),
        }
    }

    /// The next motion of both programs.
    pub(crate) fn add(&mut self, before: &Leg, after: &Leg) {
        self.stations.add(before);
        self.after.push(after.end.as_ref().ok().map(|end| {
            let mut q = [0.0; 2];
            for (slot, &joint) in q.iter_mut().zip(&self.machine.rotary) {
                *slot = end.joints[joint];
            }
            q
        }));
    }

    /// Finds the path of the program after in the graph of the program before, and checks the labels.
    pub(crate) fn judge(
        self,
        cost: PostureCost,
        labels: &[Option<u64>],
        tolerance_deg: f64,
    ) -> Result<PostureCosts, Outcome> {
        if let Some(letter) = cost.lacks(self.machine) {
            return Err(Outcome::unknown(format!(
                "the machine file does not declare the highest speed of {letter}, and the time depends on it"
            )));
        }
        let stations = self.stations.finish();
        let graph = Graph::new(self.machine, &stations, cost).map_err(|station| {
            Outcome::unknown(format!(
                "rotary position {station} of the original program is outside the travel of the rotary axes in every posture"
            ))
        })?;
        let mut path = Vec::with_capacity(stations.len());
        for (index, station) in stations.iter().enumerate() {
            let found = self.after[station.first].and_then(|q| graph.find(index, q, rad(tolerance_deg)));
            path.push(found.ok_or_else(|| {
                Outcome::refuted(format!(
                    "rotary position {index} of the changed program is none of the postures and turns that may be chosen there"
                ))
            })?);
        }
        let least = graph.prove_least(&path, labels).map_err(Outcome::refuted)?;
        let switches = |signs: &mut dyn Iterator<Item = i8>| {
            let mut last = 0;
            signs.filter(|&sign| sign != 0).fold(0, |count, sign| {
                let swapped = last * sign < 0;
                last = sign;
                count + u64::from(swapped)
            })
        };
        let billionth = |value: u64| value as f64 / 1e9;
        Ok(PostureCosts {
            stations: stations.len() as u64,
            switches_before: switches(&mut stations.iter().map(|station| station.sign)),
            switches_after: switches(&mut path.iter().map(|&state| graph.state(state).sign)),
            before: billionth(graph.written_cost()),
            after: billionth(least),
        })
    }
}
