//! The end of a command that failed: its message, and its exit status.

use serde_json::{Map, json};

use crate::failure::Failure;
use crate::{diagnostics, interrupt, output};

impl Failure {
    /// Reports the reason: for readers on standard error, for programs on standard output. Returns the exit status.
    pub fn report(self, json: bool) -> u8 {
        let mut fields = Map::new();
        let (status, message) = match self {
            Failure::AlreadyReported => return 1,
            Failure::Interrupted => return interrupt::STATUS,
            Failure::Spec(wrong) => {
                let (report, sources) = *wrong;
                if json {
                    let entries = diagnostics::entries(&report, &sources);
                    output::line(format_args!(
                        "{:#}",
                        json!({ "error": "the spec is invalid", "diagnostics": entries })
                    ));
                }
                diagnostics::print(&report, &sources);
                return 1;
            }
            Failure::Placed(ref placed) | Failure::PlacedCall(ref placed) => {
                if json {
                    let document = json!({ "error": placed.message, "place": placed.place() });
                    output::line(format_args!("{document:#}"));
                }
                diagnostics::print_placed(placed);
                return if matches!(self, Failure::Placed(_)) {
                    1
                } else {
                    2
                };
            }
            Failure::Run(message) => (1, message),
            Failure::Detailed(message, further) => {
                fields = further;
                (1, message)
            }
            Failure::Call(message) => (2, message),
        };
        if json {
            let mut document = json!({ "error": message });
            if let Some(document) = document.as_object_mut() {
                document.extend(fields);
            }
            output::line(format_args!("{document:#}"));
        }
        output::print_error(format_args!("error: {message}"));
        status
    }
}
