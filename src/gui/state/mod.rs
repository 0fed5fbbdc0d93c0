//! Everything that the window knows, as plain data, and how each part changes. Nothing is drawn here, and no work is started.

pub mod activity;
pub mod background;
pub mod dialogs;
pub mod document;
pub mod edits;
pub mod exports;
pub mod face;
pub mod fit;
pub mod followed;
pub mod hold;
pub mod lesson_tabs;
pub mod lessons;
pub mod link;
pub mod modal;
pub mod pins;
pub mod running_lesson;
pub mod sensitivity;
pub mod startup;
pub mod sweep;
pub mod switch_effect;
pub mod tour;
pub mod tradeoff;
pub mod transient;
pub mod view;
pub mod window;
