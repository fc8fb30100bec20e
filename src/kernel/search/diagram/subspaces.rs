//! The subspaces that the nodes of a layer have, each once.

use crate::linalg::modp::Residue;
use hashbrown::HashTable;
use hashbrown::hash_table::Entry;

/// No subspace: the lane does not apply.
pub(in crate::search) const NONE: u32 = u32::MAX;
/// A subspace that no node has, because there is no room for more nodes.
pub(in crate::search) const NO_ROOM: u32 = u32::MAX - 1;

/// The different subspaces of one kind that the nodes of a layer have, by number.
#[derive(Default)]
pub(in crate::search) struct Subspaces {
    /// The end of each in `data`.
    ends: Vec<usize>,
    /// The rows, packed.
    data: Vec<Residue>,
    dimensions: Vec<u16>,
    table: HashTable<(u64, u32)>,
}

impl Subspaces {
    /// Returns the zero subspace alone, as it is before any choice.
    pub(in crate::search) fn zero_alone() -> Subspaces {
        Subspaces {
            ends: vec![0],
            dimensions: vec![0],
            ..Subspaces::default()
        }
    }

    pub(in crate::search) fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns the packed rows of a subspace.
    pub(in crate::search) fn packed_rows(&self, number: u32) -> &[Residue] {
        let number = number as usize;
        let start = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.data[start..self.ends[number]]
    }

    /// Returns the dimension of a subspace.
    pub(in crate::search) fn dimension(&self, number: u32) -> u16 {
        self.dimensions[number as usize]
    }

    /// Returns the bytes of the subspaces, with the table that finds them.
    pub(in crate::search) fn held_bytes(&self) -> usize {
        let each = size_of::<usize>() + size_of::<u16>() + 2 * size_of::<(u64, u32)>();
        size_of::<Residue>() * self.data.len() + each * self.len()
    }

    /// Returns the number of a subspace, which is added if it is new and there is room. `None` if the system has no memory for it.
    pub(in crate::search) fn number_of(
        &mut self,
        (hash, packed): (u64, &[Residue]),
        dimension: u16,
        room: bool,
    ) -> Option<u32> {
        self.table.try_reserve(1, |&(h, _)| h).ok()?;
        let (ends, data) = (&self.ends, &self.data);
        let same = |&(h, number): &(u64, u32)| {
            let number = number as usize;
            let start = number.checked_sub(1).map_or(0, |before| ends[before]);
            h == hash && data[start..ends[number]] == *packed
        };
        match self.table.entry(hash, same, |&(h, _)| h) {
            Entry::Occupied(known) => Some(known.get().1),
            Entry::Vacant(_) if !room => Some(NO_ROOM),
            Entry::Vacant(new) => {
                let number = u32::try_from(self.ends.len())
                    .ok()
                    .filter(|n| *n < NO_ROOM)?;
                self.data.try_reserve(packed.len()).ok()?;
                new.insert((hash, number));
                self.data.extend_from_slice(packed);
                self.ends.push(self.data.len());
                self.dimensions.push(dimension);
                Some(number)
            }
        }
    }

    /// Keeps the subspaces that every `kinds`-th of some numbers from the first on names, and changes these to the new numbers.
    pub(in crate::search) fn retain_used(&mut self, numbers: &mut [u32], kinds: usize) {
        let mut renamed = vec![NONE; self.len()];
        let own = numbers.iter().step_by(kinds).filter(|n| **n != NONE);
        own.for_each(|n| renamed[*n as usize] = 0);
        // The start moves behind the rows that are read, and the end behind those that are kept.
        let (mut start, mut end, mut kept) = (0, 0, 0);
        for (number, to) in renamed.iter_mut().enumerate() {
            let rows = start..self.ends[number];
            start = rows.end;
            if *to != NONE {
                *to = kept;
                self.data.copy_within(rows.clone(), end);
                end += rows.len();
                self.ends[kept as usize] = end;
                self.dimensions[kept as usize] = self.dimensions[number];
                kept += 1;
            }
        }
        self.data.truncate(end);
        self.ends.truncate(kept as usize);
        self.dimensions.truncate(kept as usize);
        self.table = HashTable::new();
        let own = numbers.iter_mut().step_by(kinds).filter(|n| **n != NONE);
        own.for_each(|n| *n = renamed[*n as usize]);
    }
}

/// Returns a fixed hash. It is the same on every machine and in every run, so nothing depends on a random seed.
pub(in crate::search) fn hash_words(words: impl Iterator<Item = u64>) -> u64 {
    let mut h = 0x517c_c1b7_2722_0a95_u64;
    for x in words {
        let wide = u128::from(h ^ x) * 0x9e37_79b9_7f4a_7c15_u128;
        h = (wide >> 64) as u64 ^ wide as u64;
    }
    h
}
