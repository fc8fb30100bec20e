//! The mechanism: links, joints with their types and frames, named states, contours, and the changes a search may make.
//!
//! Values here are validated: a [`Mechanism`](mechanism::Mechanism) is connected in every state, its ids are unique,
//! and its axes are nonzero. Text formats are in `import`; nothing here reads a file.

pub mod claim;
#[cfg(test)]
pub(crate) mod drawn;
pub mod drive;
mod driven;
pub mod grip;
pub mod joint_type;
pub mod loads;
pub mod mechanism;
pub mod ranking;
pub mod rounded;
mod search_spec;
pub mod valid;

use serde::Serialize;
use std::ops::{Index, IndexMut};

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
        pub struct $name(usize);

        impl $name {
            /// Creates the id of the element at this index of its list.
            #[must_use]
            pub const fn new(index: usize) -> Self {
                Self(index)
            }

            /// Returns the element's index in its list, from 0.
            #[must_use]
            pub const fn index(self) -> usize {
                self.0
            }

            /// Returns the ids of the first `count` elements, in order.
            pub fn first(count: usize) -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator + Clone + use<> {
                (0..count).map(Self)
            }
        }

        impl<T> Index<$name> for [T] {
            type Output = T;

            fn index(&self, id: $name) -> &T {
                &self[id.0]
            }
        }

        impl<T> IndexMut<$name> for [T] {
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.0]
            }
        }

        impl<T> Index<$name> for Vec<T> {
            type Output = T;

            fn index(&self, id: $name) -> &T {
                &self[id.0]
            }
        }

        impl<T> IndexMut<$name> for Vec<T> {
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.0]
            }
        }
    };
}

id! {
    /// A link, by its index in [`Parts::links`](mechanism::Parts::links).
    LinkId
}

id! {
    /// A joint, by its index in [`Parts::joints`](mechanism::Parts::joints).
    JointId
}

id! {
    /// A state, by its index in [`Parts::states`](mechanism::Parts::states).
    StateId
}

impl StateId {
    /// The state that every mechanism has, with nothing clamped or added; the first of a file.
    pub const FREE: StateId = StateId(0);
}
