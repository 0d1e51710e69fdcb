//! The rules that the sources keep: rooms, style, the generated header.

#[path = "../header/items.rs"]
#[allow(dead_code)] // Each test uses a part.
mod items;
#[path = "../header/layout.rs"]
#[allow(dead_code)] // Each test uses a part.
mod layout;
#[path = "../common/modules.rs"]
#[allow(dead_code)] // Each test uses a part.
mod modules;
#[path = "../common/sources.rs"]
#[allow(dead_code)] // Each test uses a part.
mod sources;

mod bindings;
mod header;
mod law_room;
mod layering;
mod notices;
mod style;
