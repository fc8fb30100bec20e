//! Of the graphs in graph6 on standard input writes those without a rigid part: no set S of two vertices or more with
//! 3(|S| - 1) - 2e(S) < 1. With `--count` only how many there are.
//!
//! A (3, 4) pebble game on the graph with every edge twice [Lee & Streinu 2008]: shares no code and no idea with `ozols`, which
//! never makes a graph that it must throw away.

use std::io::{self, BufRead, BufWriter, Write};

const PEBBLES: u8 = 3;

struct Game {
    vertices: usize,
    free: [u8; 32],
    /// How many of the at most two copies of an edge are held by a pebble of the first vertex.
    held: [[u8; 32]; 32],
}

impl Game {
    /// Brings a free pebble to a vertex from one that can be reached, without touching those of `kept`.
    fn fetch(&mut self, to: usize, kept: usize) -> bool {
        let mut from = [usize::MAX; 32];
        let mut queue = vec![to];
        from[to] = to;
        from[kept] = kept;
        let mut next = 0;
        while let Some(&u) = queue.get(next) {
            next += 1;
            for v in 0..self.vertices {
                if self.held[u][v] == 0 || from[v] != usize::MAX {
                    continue;
                }
                from[v] = u;
                if self.free[v] == 0 {
                    queue.push(v);
                    continue;
                }
                self.free[v] -= 1;
                let mut at = v;
                while at != to {
                    let before = from[at];
                    self.held[before][at] -= 1;
                    self.held[at][before] += 1;
                    at = before;
                }
                self.free[to] += 1;
                return true;
            }
        }
        false
    }

    /// Whether an edge is independent of those so far, which then has it.
    fn insert(&mut self, u: usize, v: usize) -> bool {
        // One pebble more than the 4 that every part keeps.
        while self.free[u] + self.free[v] < 5 {
            let short_first = self.free[u] < PEBBLES && self.fetch(u, v);
            if !short_first && !(self.free[v] < PEBBLES && self.fetch(v, u)) {
                return false;
            }
        }
        let (u, v) = if self.free[u] > 0 { (u, v) } else { (v, u) };
        self.free[u] -= 1;
        self.held[u][v] += 1;
        true
    }
}

fn edges(graph: &[u8]) -> (usize, Vec<(usize, usize)>) {
    let vertices = usize::from(graph[0] - 63);
    let bit = |i: usize| (graph[1 + i / 6] - 63) >> (5 - i % 6) & 1 == 1;
    let pairs = (0..vertices).flat_map(|v| (0..v).map(move |u| (u, v)));
    (vertices, pairs.enumerate().filter(|(i, _)| bit(*i)).map(|(_, e)| e).collect())
}

fn has_no_rigid_part(graph: &[u8]) -> bool {
    let (vertices, edges) = edges(graph);
    let mut game = Game { vertices, free: [PEBBLES; 32], held: [[0; 32]; 32] };
    edges.into_iter().all(|(u, v)| game.insert(u, v) && game.insert(u, v))
}

fn main() -> io::Result<()> {
    let counts = std::env::args().any(|a| a == "--count");
    let mut out = BufWriter::new(io::stdout().lock());
    let mut found = 0u64;
    let (mut input, mut line) = (io::stdin().lock(), Vec::new());
    while { line.clear(); input.read_until(b'\n', &mut line)? > 0 } {
        if has_no_rigid_part(line.trim_ascii_end()) {
            found += 1;
            if !counts {
                out.write_all(&line)?;
            }
        }
    }
    if counts { writeln!(out, "{found}") } else { Ok(()) }
}
