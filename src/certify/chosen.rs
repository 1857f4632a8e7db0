//! The postures that a program takes, and whether no others cost less.
use crate::Outcome;
use crate::certificate::PostureCosts;
use crate::postures::{Graph, PostureCost, Stations, changes_of_posture};
use trunnion_geometry::rad;
use trunnion_machine::{Leg, Machine};

/// Postures before and after, motion by motion.
pub(crate) struct Chosen<'m> {
    machine: &'m Machine,
    stations: Stations<'m>,
    /// Rotary joints of each motion of the program after, rad; none where its end is unknown.
    after: Vec<Option<[f64; 2]>>,
    /// Line of each of them in the program after.
    lines: Vec<u32>,
}

impl<'m> Chosen<'m> {
    pub(crate) fn new(machine: &'m Machine) -> Self {
        Self {
            machine,
            stations: Stations::new(machine),
            after: Vec::new(),
            lines: Vec::new(),
        }
    }

    /// The next motion of both programs; `line`: in the program after.
    pub(crate) fn add(&mut self, before: &Leg, after: &Leg, line: u32) {
        self.lines.push(line);
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
        &self,
        cost: PostureCost,
        labels: &[Option<u64>],
        tolerance_deg: f64,
    ) -> Result<PostureCosts, Outcome> {
        if let Some(letter) = cost.lacks(self.machine) {
            return Err(Outcome::unknown(format!(
                "the machine file does not declare the highest speed of {letter}, and the time depends on it"
            )));
        }
        let stations = self.stations.all();
        let graph = Graph::new(self.machine, stations, cost).map_err(|station| {
            Outcome::unknown(format!(
                "line {}: no posture of the original program reaches this tool axis inside the travel of the rotary axes",
                self.lines[stations[station].first]
            ))
        })?;
        let mut path = Vec::with_capacity(stations.len());
        for (index, station) in stations.iter().enumerate() {
            let found = self.after[station.first].and_then(|q| graph.find(index, q, rad(tolerance_deg)));
            path.push(found.ok_or_else(|| {
                self.refute(
                    station.first,
                    "the rotary axes are at none of the postures and turns that may be chosen here",
                )
            })?);
        }
        let least = graph
            .prove_least(&path, labels)
            .map_err(|(station, why)| self.refute(stations.get(station).map_or(0, |station| station.first), &why))?;
        let billionth = |value: u64| value as f64 / 1e9;
        Ok(PostureCosts {
            stations: stations.len() as u64,
            switches_before: changes_of_posture(stations.iter().map(|station| station.sign)),
            switches_after: changes_of_posture(path.iter().map(|&state| graph.state(state).sign)),
            before: billionth(graph.written_cost()),
            after: billionth(least),
        })
    }

    /// Refuted at a motion.
    fn refute(&self, motion: usize, why: &str) -> Outcome {
        Outcome::refuted_at(motion, self.lines.get(motion).copied().unwrap_or(1), why)
    }
}
