//! Copies that cannot fail: what does not fit is left out. They are not inlined, because a small
//! core should have only one copy of each.

/// Copies as many bytes as both slices have.
#[inline(never)]
pub(crate) fn copy(to: &mut [u8], from: &[u8]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// Moves the bytes of `[from, end)` to the front.
#[inline(never)]
pub(crate) fn move_down(bytes: &mut [u8], from: usize, end: usize) {
    if from == 0 {
        return;
    }
    // Byte by byte: the library's function for this can panic.
    for place in from..end {
        let byte = at(bytes, place);
        if let Some(free) = bytes.get_mut(place.wrapping_sub(from)) {
            *free = byte;
        }
    }
}

/// The slice `[from, from + count)`; empty if it is not all there.
#[inline(never)]
pub(crate) fn part(bytes: &[u8], from: usize, count: usize) -> &[u8] {
    bytes.get(from..).and_then(|rest| rest.get(..count)).unwrap_or_default()
}

/// The slice `[from, from + count)` for writing; empty if it is not all there.
#[inline(never)]
pub(crate) fn part_mut(bytes: &mut [u8], from: usize, count: usize) -> &mut [u8] {
    bytes.get_mut(from..).and_then(|rest| rest.get_mut(..count)).unwrap_or_default()
}

/// Splits at `at`, or at the end if that comes first.
#[inline(never)]
pub(crate) fn split(bytes: &mut [u8], at: usize) -> (&mut [u8], &mut [u8]) {
    let at = at.min(bytes.len());
    bytes.split_at_mut_checked(at).unwrap_or_default()
}

/// The byte at a place; 0 if there is none.
pub(crate) fn at(bytes: &[u8], place: usize) -> u8 {
    bytes.get(place).copied().unwrap_or_default()
}

/// The 32-bit number at a place, in network byte order.
#[inline(never)]
pub(crate) fn word(bytes: &[u8], place: usize) -> u32 {
    let wanted = bytes.get(place..).and_then(<[u8]>::first_chunk);
    wanted.copied().map_or(0, u32::from_be_bytes)
}

/// Writes from the front and drops what does not fit.
pub(crate) struct Writer<'a> {
    bytes: &'a mut [u8],
    pub(crate) size: usize,
    pub(crate) is_full: bool,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(bytes: &'a mut [u8]) -> Self {
        Self { bytes, size: 0, is_full: false }
    }

    #[inline(never)]
    pub(crate) fn put(&mut self, bytes: &[u8]) {
        let end = self.size.wrapping_add(bytes.len());
        match self.bytes.get_mut(self.size..end) {
            Some(room) => {
                copy(room, bytes);
                self.size = end;
            }
            None => self.is_full = true,
        }
    }

    pub(crate) fn written(&self) -> &[u8] {
        self.bytes.get(..self.size).unwrap_or_default()
    }
}
