//! Parameters of requests in, and their answers or the reasons why there is none out.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// What a request has for an answer.
pub(crate) type Answer = Result<Value, Refusal>;

/// Why a request has no answer.
#[derive(Debug)]
pub(crate) enum Refusal {
    /// Its parameters are not those of the protocol.
    Parameters(String),
    /// It cannot be done: the reason, for people.
    Impossible(String),
    /// There was no time, or a newer message came first.
    Cancelled,
}

/// The parameters of a request.
///
/// # Errors
/// They are not those that it should have.
pub(crate) fn parameters<T: DeserializeOwned>(params: Value) -> Result<T, Refusal> {
    serde_json::from_value(params).map_err(|why| Refusal::Parameters(why.to_string()))
}

/// The parameters of a notification, if they are those that it should have.
pub(crate) fn of<T: DeserializeOwned>(params: Value) -> Option<T> {
    serde_json::from_value(params).ok()
}

/// An answer.
///
/// # Errors
/// None but those of serde.
pub(crate) fn told<T: Serialize>(answer: T) -> Answer {
    serde_json::to_value(answer).map_err(|why| Refusal::Impossible(why.to_string()))
}
