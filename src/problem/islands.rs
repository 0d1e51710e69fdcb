//! Islands: the pairs of a sparse matrix in groups that no entry ties to each other, connected components of its
//! graph over the pairs; or other things that are tied to each other.

/// A partition of pairs. Islands are in the order of their first pairs.
#[derive(Clone, Debug)]
pub struct Islands {
    /// Begin of each island in `members`, and the end of the last one.
    starts: Vec<usize>,
    /// The pairs of each island, ascending.
    members: Vec<usize>,
}

impl Islands {
    /// The islands of so many pairs, which `ties` connect: each two pairs at a time.
    pub fn new(pairs: usize, ties: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut parents: Vec<usize> = (0..pairs).collect();
        for (one, other) in ties {
            let (one, other) = (root(&mut parents, one), root(&mut parents, other));
            parents[one.max(other)] = one.min(other);
        }
        let roots: Vec<usize> = (0..pairs).map(|pair| root(&mut parents, pair)).collect();
        let mut members: Vec<usize> = (0..pairs).collect();
        members.sort_unstable_by_key(|&pair| (roots[pair], pair));
        let (mut starts, mut end) = (vec![0], 0);
        for island in members.chunk_by(|&one, &other| roots[one] == roots[other]) {
            end += island.len();
            starts.push(end);
        }
        Islands { starts, members }
    }

    /// Number of islands.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The pairs of an island, ascending.
    pub fn pairs(&self, island: usize) -> &[usize] {
        &self.members[self.starts[island]..self.starts[island + 1]]
    }

    /// The pairs of each island.
    pub fn each(&self) -> impl Iterator<Item = &[usize]> {
        (0..self.len()).map(|island| self.pairs(island))
    }

    /// The pairs of the largest island, the first of those; nothing if there is none.
    pub fn largest(&self) -> &[usize] {
        let sizes = self.each().map(<[usize]>::len).enumerate();
        let first = sizes.max_by_key(|&(island, size)| (size, std::cmp::Reverse(island)));
        first.map_or(&[], |(island, _)| self.pairs(island))
    }
}

/// The first pair of the tree that a pair is in; the way there is halved.
fn root(parents: &mut [usize], mut pair: usize) -> usize {
    while parents[pair] != pair {
        parents[pair] = parents[parents[pair]];
        pair = parents[pair];
    }
    pair
}
