//! The state of a contact pair, as results and certificates tell it.

/// The state of a contact pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum State {
    /// Apart: no force; under Tresca's law no normal force, with cohesion the tension.
    Open,
    /// In contact with the tangential force on its bound; also every contact without friction.
    Slip,
    /// In contact without slip.
    Stick,
}
