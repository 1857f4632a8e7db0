//! Postures and windings of a whole program as a graph, and the proof that a path through it is the cheapest.
//!
//! A [`Station`] is a position of the rotary axes that one or more motions share. Its states are the postures and windings that reach the
//! same tool axis inside the travel of the axes; an edge joins states of consecutive stations. Whoever searches the graph hands over a
//! label for each state; [`Graph::prove_least`] checks that no edge is cheaper than the difference of its labels, and that the path costs
//! what the labels say. Then no path is cheaper (duality of shortest paths). The check needs no search.
mod cost;
mod graph;
mod station;

pub use cost::PostureCost;
pub use graph::{Graph, State, changes_of_posture};
pub use station::{Freedom, Station, Stations};
