//! The handle of a model.

use std::sync::Mutex;

use super::args::Arrays;
use super::guard::{self, Failure};
use crate::model::{Model, Past};

/// A structure reduced to its contact pairs, for all load cases. It does not change: several
/// threads may use one at once (but see SIGNORINI_START_PREVIOUS).
pub struct SignoriniModel {
    model: Model,
    /// The result that calls with SIGNORINI_START_PREVIOUS have left; nothing while one is at work.
    past: Mutex<Option<Past>>,
}

impl From<Model> for SignoriniModel {
    fn from(model: Model) -> Self {
        SignoriniModel { model, past: Mutex::new(None) }
    }
}

impl SignoriniModel {
    pub(super) fn model(&self) -> &Model {
        &self.model
    }

    /// Puts what is left for further calls, and returns what earlier ones have left.
    #[inline(never)] // tests/c/helgrind.supp names it
    pub(super) fn replace_past(&self, past: Option<Past>) -> Option<Past> {
        // A call that ends early, by a shortage of memory too, has nothing in hand. No call waits for the lock: after
        // a fork it may belong to a thread that is not there.
        self.past.try_lock().map_or(None, |mut place| std::mem::replace(&mut place, past))
    }
}

impl<'h> Arrays<'h> {
    /// The first argument, a model.
    pub(super) fn model(&self, model: *const SignoriniModel) -> Result<&'h Model, Failure> {
        self.model_handle(model).map(SignoriniModel::model)
    }

    /// As [`Self::model`], with what calls leave to the next ones.
    pub(super) fn model_handle(
        &self,
        model: *const SignoriniModel,
    ) -> Result<&'h SignoriniModel, Failure> {
        guard::prepare_thread()?;
        self.handle(1, "model", model)
    }
}
