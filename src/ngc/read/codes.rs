//! G and M codes of the control and their modal groups (found by running `rs274` with each code and each pair of codes).

/// The modal group of a G code, given as ten times its number; `None`: the control does not know it.
#[inline]
pub(super) fn g_group(code: i16) -> Option<usize> {
    let group = *G_GROUPS.get(usize::try_from(code).ok()?)?;
    (group != NO_GROUP).then_some(usize::from(group))
}

/// No G code.
const NO_GROUP: u8 = u8::MAX;

/// The groups of G0 to G99.9.
static G_GROUPS: [u8; 1000] = {
    let mut groups = [NO_GROUP; 1000];
    let mut code = 0;
    while code < groups.len() {
        groups[code] = group_of(code);
        code += 1;
    }
    groups
};

const fn group_of(code: usize) -> u8 {
    match code {
        40 | 53 | 100 | 280 | 281 | 300 | 301 | 520 | 530 | 920 => 0,
        // lines, arcs, splines, threads, probing; then the cycles, and 800, which ends them
        0
        | 10
        | 20
        | 30
        | 50..=52
        | 330
        | 331
        | 382..=385
        | 700
        | 710..=712
        | 720..=722
        | 730
        | 740
        | 760
        | 800
        | 810
        | 820
        | 830
        | 840
        | 850
        | 860
        | 870
        | 880
        | 890 => 1,
        170 | 171 | 180 | 181 | 190 | 191 => 2,
        900 | 910 => 3,
        901 | 911 => 4,
        930 | 940 | 950 => 5,
        200 | 210 => 6,
        400 | 410 | 411 | 420 | 421 => 7,
        430..=432 | 490 => 8,
        980 | 990 => 10,
        540 | 550 | 560 | 570 | 580 | 590..=593 => 12,
        610 | 611 | 640 => 13,
        960 | 970 => 14,
        70 | 80 => 15,
        921..=923 => 16,
        _ => NO_GROUP,
    }
}

/// The modal group of an M code of 0 to 199; `None`: the control does not know it.
pub(super) fn m_group(code: i32) -> Option<usize> {
    Some(match code {
        0..=2 | 30 | 60 | 99 => 4,
        62..=68 => 5,
        6 | 61 => 6,
        3..=5 | 19 | 70..=73 => 7,
        7..=9 => 8,
        48..=53 => 9,
        100..=199 => 10,
        _ => return None,
    })
}

/// G80: any other motion code of the line overrides it, whichever comes first.
pub(super) const CANCEL: i16 = 800;
