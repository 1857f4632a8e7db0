//! The cheapest path through the postures and turns of a program, and a label for each of them that proves it.
use trunnion_certify::postures::Graph;

/// The cheapest path.
pub(crate) struct Cheapest {
    /// The state of each station.
    pub path: Vec<usize>,
    /// The least cost of reaching each state, billionths; none where it cannot be reached.
    pub labels: Vec<Option<u64>>,
}

/// How paths are ordered: by cost, then by rotary travel (a deviation may be zero everywhere), then by how many stations differ from the
/// program as written; where all are equal, the state that is listed first wins.
type Rank = (u64, u64, u32);

/// Dynamic programming over the stations: each state keeps the best path that ends there (Bellman 1957). `None`: no path is allowed.
pub(crate) fn cheapest(graph: &Graph<'_>) -> Option<Cheapest> {
    let count = graph.stations().len();
    let mut ranks: Vec<Option<Rank>> = vec![None; graph.len()];
    let mut parents: Vec<usize> = vec![usize::MAX; graph.len()];
    let edits = |state: usize| u32::from(!graph.state(state).written);
    for state in graph.states_of(0) {
        ranks[state] = Some((0, 0, edits(state)));
    }
    for station in 1..count {
        for to in graph.states_of(station) {
            for from in graph.states_of(station - 1) {
                let Some(before) = ranks[from] else { continue };
                let Some(cost) = graph.edge(station, from, to) else {
                    continue;
                };
                let rank = (
                    before.0.saturating_add(cost),
                    before.1.saturating_add(graph.travel(station, from, to)),
                    before.2 + edits(to),
                );
                if ranks[to].is_none_or(|known| rank < known) {
                    ranks[to] = Some(rank);
                    parents[to] = from;
                }
            }
        }
    }
    let mut at = graph
        .states_of(count.checked_sub(1)?)
        .filter(|&state| ranks[state].is_some())
        .min_by_key(|&state| ranks[state])?;
    let mut path = vec![at];
    while parents[at] != usize::MAX {
        at = parents[at];
        path.push(at);
    }
    path.reverse();
    Some(Cheapest {
        path,
        labels: ranks.into_iter().map(|rank| rank.map(|(cost, _, _)| cost)).collect(),
    })
}
