//! Every choice of options in order of cost, without a diagram: for spaces too large to be looked at whole.

use crate::search::answer::keys::{Key, Steps};

/// Sums of costs told apart at most, over all variables.
const MOST_SUMS: u64 = 1 << 26;

/// Choices, cheapest first, those of equal cost in the order of their numbers.
///
/// # Complexity
/// Memory: a byte for each variable and each cost up to the dearest. Time: some steps for each choice given, since no way is
/// entered that does not end at the cost in question.
pub(in crate::search) struct InOrder {
    /// `costs[variable][choice]`, in steps.
    costs: Vec<Vec<u64>>,
    /// `reached[variable]`: which sums the variables from this one on can make.
    reached: Vec<Vec<bool>>,
    /// The cost in question; none before the first.
    level: Option<usize>,
    /// For each variable entered, the choice to try next, and what is left of the cost before it.
    path: Vec<(usize, usize)>,
}

impl InOrder {
    /// Of a space's costs; `None` where they are told apart too finely.
    pub(in crate::search) fn new(steps: &Steps) -> Option<InOrder> {
        let of = |keys: &Vec<Key>| -> Vec<u64> { keys.iter().map(|k| k.cost()).collect() };
        let costs: Vec<Vec<u64>> = steps.keys.iter().map(of).collect();
        let dearest = |c: &Vec<u64>| c.iter().max().copied().unwrap_or(0);
        let most = costs
            .iter()
            .try_fold(0u64, |sum, c| sum.checked_add(dearest(c)))
            .filter(|m| m.saturating_mul(costs.len() as u64) <= MOST_SUMS)?;
        let most = usize::try_from(most).ok()?;
        let mut reached = vec![vec![false; most + 1]; costs.len() + 1];
        reached[costs.len()][0] = true;
        for v in (0..costs.len()).rev() {
            for sum in (0..=most)
                .filter(|&s| reached[v + 1][s])
                .collect::<Vec<_>>()
            {
                for &c in &costs[v] {
                    let to = usize::try_from(c).ok().and_then(|c| sum.checked_add(c));
                    if let Some(to) = to.filter(|t| *t <= most) {
                        reached[v][to] = true;
                    }
                }
            }
        }
        Some(InOrder {
            costs,
            reached,
            level: None,
            path: Vec::new(),
        })
    }

    /// The next cost that some choice has.
    fn rise(&mut self) -> Option<()> {
        let from = self.level.map_or(0, |l| l + 1);
        let rest = self.reached[0].iter().enumerate().skip(from);
        let level = rest.filter(|(_, r)| **r).map(|(l, _)| l).next()?;
        self.level = Some(level);
        self.path.push((0, level));
        Some(())
    }
}

impl Iterator for InOrder {
    type Item = Vec<usize>;

    fn next(&mut self) -> Option<Vec<usize>> {
        loop {
            let depth = self.path.len();
            let Some(&(choice, left)) = self.path.last() else {
                self.rise()?;
                if self.costs.is_empty() {
                    self.path.clear();
                    return Some(Vec::new());
                }
                continue;
            };
            let Some(&cost) = self.costs[depth - 1].get(choice) else {
                self.path.pop();
                continue;
            };
            self.path[depth - 1].0 += 1;
            let rest = usize::try_from(cost).ok().and_then(|c| left.checked_sub(c));
            let Some(rest) = rest.filter(|r| self.reached[depth][*r]) else {
                continue;
            };
            if depth == self.costs.len() {
                return Some(self.path.iter().map(|(next, _)| next - 1).collect());
            }
            self.path.push((0, rest));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::InOrder;
    use crate::search::answer::keys::{Key, Steps};

    #[test]
    fn every_choice_comes_once_and_none_before_a_cheaper_one() {
        let costs = [vec![0, 3, 1], vec![2, 0], vec![0], vec![5, 5, 0, 1]];
        let key = |c: &u64| Key::new(*c, 0, 0);
        let steps = Steps::of_keys(costs.iter().map(|v| v.iter().map(key).collect()).collect());
        let all: Vec<Vec<usize>> = InOrder::new(&steps).expect("small").collect();
        let cost = |c: &Vec<usize>| c.iter().zip(&costs).map(|(&i, v)| v[i]).sum::<u64>();
        assert!(
            all.windows(2)
                .all(|w| (cost(&w[0]), &w[0]) < (cost(&w[1]), &w[1]))
        );
        assert_eq!(all.len(), 24);
    }
}
