//! The choices of a host for a reduction: its order of elimination, its threads, and whether to go on.

use crate::error::{Argument, Error, entry, index};
use crate::linalg::sparse_schur::Failure;

/// Is asked between steps whether to go on: the share of the work that is done, and the bytes that it needs
/// in all, 0 before they are known.
type Ask<'a> = dyn FnMut(f64, u64) -> Result<(), Error> + 'a;

/// The order of elimination, who works, what obtains memory, and who is asked.
pub struct Control<'a> {
    /// Each degree of freedom once, the first to be eliminated first; `None`: chosen.
    pub order: Option<&'a [usize]>,
    /// `true`: no condensed matrix is formed.
    pub full_space: bool,
    /// Obtains so many bytes for a condensed matrix before it is begun; `false`: the system refuses them.
    pub reserve: fn(u64) -> bool,
    /// Bytes that a load case takes beside the model and its factor, of so many inner unknowns, if it is in full space, and
    /// components of pairs.
    pub case: fn(Option<usize>, usize) -> u64,
    /// Asked between steps.
    pub ask: &'a mut Ask<'a>,
}

/// Passes questions on, and keeps the answer that ended the work.
pub(super) struct Asked<'a, 'b> {
    ask: &'b mut Ask<'a>,
    /// Bytes that the work needs in all, 0 before they are known.
    pub(super) memory: u64,
    pub(super) ended: Option<Error>,
}

impl<'a, 'b> Asked<'a, 'b> {
    pub(super) fn new(ask: &'b mut Ask<'a>) -> Self {
        Asked { ask, memory: 0, ended: None }
    }

    /// Passes a question on: this share of the work is done.
    pub(super) fn goes_on(&mut self, share: f64) -> Result<(), Failure> {
        (self.ask)(share, self.memory).map_err(|error| {
            self.ended = Some(error);
            Failure::Stopped
        })
    }

    /// Asks before a work begins that needs so many bytes in all.
    pub(super) fn needs(&mut self, memory: u64) -> Result<(), Failure> {
        self.memory = memory;
        self.goes_on(0.0)
    }
}

/// The place in `order` of each of `size` degrees of freedom.
///
/// # Errors
/// Not a permutation: which entry.
pub(super) fn ranks(size: usize, order: &[usize]) -> Result<Vec<usize>, Error> {
    if order.len() != size {
        let given = order.len();
        return Argument::Order.refuse(format!(
            "order has {given} entries, it must have one for each of {size} rows"
        ));
    }
    let mut ranks = vec![usize::MAX; size];
    for (k, &dof) in order.iter().enumerate() {
        let (place, number) = (entry("order", [k]), index(dof));
        let Some(rank) = ranks.get_mut(dof) else {
            let wrong = format!("{place} is {number}, there is no such degree of freedom");
            return Argument::Order.refuse(wrong);
        };
        if *rank != usize::MAX {
            let before = entry("order", [*rank]);
            return Argument::Order.refuse(format!(
                "{place} is {number}, as {before} is: order must have each degree of freedom once"
            ));
        }
        *rank = k;
    }
    Ok(ranks)
}
