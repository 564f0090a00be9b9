//! What can be said of signals: terms are numbers, formulas are true or false.

/// A number at each moment.
#[derive(Clone, Debug, PartialEq)]
pub enum Term {
    /// The signal with that number.
    Signal(usize),
    /// The same at all times.
    Number(f64),
    /// The other sign.
    Negative(Box<Self>),
    /// Without its sign.
    Absolute(Box<Self>),
    /// A sum.
    Sum(Box<Self>, Box<Self>),
    /// A difference.
    Difference(Box<Self>, Box<Self>),
    /// A product.
    Product(Box<Self>, Box<Self>),
    /// A quotient; no number where it divides by 0, and no comparison with it holds.
    Quotient(Box<Self>, Box<Self>),
    /// The smaller one.
    Least(Box<Self>, Box<Self>),
    /// The greater one.
    Greatest(Box<Self>, Box<Self>),
}

/// How two numbers are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compare {
    /// `<`
    Less,
    /// `<=`
    AtMost,
    /// `>`
    Greater,
    /// `>=`
    AtLeast,
    /// `==`
    Equal,
    /// `!=`
    Unequal,
}

/// True or false at each moment. Intervals are nanoseconds after that moment, both ends included.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// A comparison.
    Compare(Term, Compare, Term),
    /// The opposite.
    Not(Box<Self>),
    /// Both.
    And(Box<Self>, Box<Self>),
    /// One of them, or both.
    Or(Box<Self>, Box<Self>),
    /// The second one where the first one holds.
    Implies(Box<Self>, Box<Self>),
    /// It has just become true.
    Rising(Box<Self>),
    /// At all times of the interval.
    Always(u64, u64, Box<Self>),
    /// At some time of the interval.
    Eventually(u64, u64, Box<Self>),
}

impl Term {
    /// Its value where those of its signals are known; `None` where one is missing, or something is divided by 0.
    #[must_use]
    pub fn at(&self, signal: &dyn Fn(usize) -> Option<f64>) -> Option<f64> {
        let two = |one: &Self, other: &Self| Some((one.at(signal)?, other.at(signal)?));
        match self {
            Self::Signal(number) => signal(*number),
            Self::Number(value) => Some(*value),
            Self::Negative(one) => one.at(signal).map(|value| -value),
            Self::Absolute(one) => one.at(signal).map(f64::abs),
            Self::Sum(one, other) => two(one, other).map(|(one, other)| one + other),
            Self::Difference(one, other) => two(one, other).map(|(one, other)| one - other),
            Self::Product(one, other) => two(one, other).map(|(one, other)| one * other),
            Self::Quotient(one, other) => {
                two(one, other).filter(|of| of.1 != 0.0).map(|(one, other)| one / other)
            }
            Self::Least(one, other) => two(one, other).map(|(one, other)| one.min(other)),
            Self::Greatest(one, other) => two(one, other).map(|(one, other)| one.max(other)),
        }
    }

    /// Calls back with the number of each signal in it.
    pub fn for_each_signal(&self, seen: &mut dyn FnMut(usize)) {
        match self {
            Self::Signal(number) => seen(*number),
            Self::Number(_) => {}
            Self::Negative(one) | Self::Absolute(one) => one.for_each_signal(seen),
            Self::Sum(one, other)
            | Self::Difference(one, other)
            | Self::Product(one, other)
            | Self::Quotient(one, other)
            | Self::Least(one, other)
            | Self::Greatest(one, other) => {
                one.for_each_signal(seen);
                other.for_each_signal(seen);
            }
        }
    }
}

impl Formula {
    /// Calls back with the number of each signal in it.
    pub fn for_each_signal(&self, seen: &mut dyn FnMut(usize)) {
        match self {
            Self::Compare(one, _, other) => {
                one.for_each_signal(seen);
                other.for_each_signal(seen);
            }
            Self::Not(one) | Self::Rising(one) => one.for_each_signal(seen),
            Self::Always(_, _, one) | Self::Eventually(_, _, one) => one.for_each_signal(seen),
            Self::And(one, other) | Self::Or(one, other) | Self::Implies(one, other) => {
                one.for_each_signal(seen);
                other.for_each_signal(seen);
            }
        }
    }
}
