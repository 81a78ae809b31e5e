//! Which lines of a file are meant.

use super::features::{Feature, Features, Heights, Kind};
use super::surface::LISTED;
use crate::model::Note;
use crate::read::error::{clip, refuse};
use crate::read::{Pick, ReadError};

/// A line to be taken, with the profile asked for.
pub(super) struct Chosen<'f> {
    pub(super) feature: &'f Feature,
    /// `None`: its only design profile, if it has one.
    pub(super) profile: Option<&'f Heights>,
}

/// The lines meant: those of the names given, else alignments or plan features, else what there is.
///
/// # Errors
/// If nothing fits, or lines of both kinds do; the message lists what there is.
pub(super) fn choose<'f>(
    label: &str,
    features: &'f Features,
    pick: &Pick,
    notes: &mut Vec<Note>,
) -> Result<Vec<Chosen<'f>>, ReadError> {
    let found = &features.found;
    if found.is_empty() {
        let figures = match features.surfaces {
            0 => "there is no CoordGeom and no Breakline".to_owned(),
            n => format!("it holds {n} {}", if n == 1 { "surface" } else { "surfaces" }),
        };
        return Err(refuse(
            "the file holds no line",
            label,
            figures,
            "give the line in another file; a surface is ground: `--terrain`",
        ));
    }
    let chosen = if pick.features.is_empty() { by_kind(label, found)? } else { by_name(label, found, pick)? };
    // Those taken with several profiles stand one after the other.
    let taken: Vec<&Feature> =
        chosen.chunk_by(|a, b| std::ptr::eq(a.feature, b.feature)).filter_map(|run| run.first()).map(|c| c.feature).collect();
    let left: Vec<String> = Kind::ALL
        .into_iter()
        .map(|kind| (kind, found.iter().filter(|f| f.kind == kind).count() - taken.iter().filter(|f| f.kind == kind).count()))
        .filter(|(_, count)| *count > 0)
        .map(|(kind, count)| format!("{count} {}", kind.name(count)))
        .chain(
            (features.surfaces > 0)
                .then(|| format!("{} {}", features.surfaces, if features.surfaces == 1 { "surface" } else { "surfaces" })),
        )
        .collect();
    if !left.is_empty() {
        let names: Vec<String> = taken.iter().take(LISTED).map(|feature| feature.text()).collect();
        let more = if taken.len() > LISTED { format!(" and {} more", taken.len() - LISTED) } else { String::new() };
        let message = format!("taken from the file: {}{more}; left: {}", names.join(", "), left.join(", "));
        notes.push(Note::new("landxml-taken", message));
    }
    Ok(chosen)
}

fn by_kind<'f>(label: &str, found: &'f [Feature]) -> Result<Vec<Chosen<'f>>, ReadError> {
    // Alignments without elements are taken only where there is nothing else: the message tells what they lack.
    let empty = found.iter().all(|feature| feature.parts.is_empty());
    let of = |kind| found.iter().filter(move |feature| feature.kind == kind && (empty || !feature.parts.is_empty()));
    let some = |kind| of(kind).next().is_some();
    if some(Kind::Alignment) && some(Kind::Plan) {
        let help = "say which ones with `--feature NAME`; it may be repeated";
        return Err(refuse("the file holds alignments and plan features", label, listed(found), help));
    }
    let kind = Kind::ALL.into_iter().find(|kind| some(*kind));
    Ok(kind.into_iter().flat_map(of).map(|feature| Chosen { feature, profile: None }).collect())
}

/// The lines of the names asked for, in the order of the file; an alignment once for each of its profiles that is.
fn by_name<'f>(label: &str, found: &'f [Feature], pick: &Pick) -> Result<Vec<Chosen<'f>>, ReadError> {
    let mut used = vec![false; pick.features.len()];
    let mut chosen = Vec::new();
    for feature in found {
        let Some(name) = feature.name.as_deref().map(str::trim) else { continue };
        let before = chosen.len();
        for (i, wanted) in pick.features.iter().enumerate() {
            let wanted = wanted.trim();
            let own = || wanted.strip_prefix(name).and_then(|rest| rest.strip_prefix('/'));
            let profile = own().and_then(|own| {
                feature.road.profiles.iter().find(|profile| profile.name.as_deref().map(str::trim) == Some(own.trim()))
            });
            if wanted == name || profile.is_some() {
                used[i] = true;
                let same = |taken: &Chosen<'_>| match (taken.profile, profile) {
                    (Some(a), Some(b)) => std::ptr::eq(a, b),
                    (a, b) => a.is_none() && b.is_none(),
                };
                if !chosen[before..].iter().any(same) {
                    chosen.push(Chosen { feature, profile });
                }
            }
        }
    }
    match pick.features.iter().zip(&used).find(|(_, used)| !**used) {
        None => Ok(chosen),
        Some((name, _)) => {
            let what = format!("there is no line `{}`", clip(name.as_bytes()));
            Err(refuse(&what, label, listed(found), "give names from the file, or leave `--feature` out"))
        }
    }
}

/// The lines of a file, in short: each name once.
fn listed(found: &[Feature]) -> String {
    let mut names: Vec<String> = Vec::new();
    let mut more = 0;
    for feature in Kind::ALL.into_iter().flat_map(|kind| found.iter().filter(move |feature| feature.kind == kind)) {
        let text = feature.text();
        if names.contains(&text) {
            continue;
        }
        if names.len() < LISTED { names.push(text) } else { more += 1 }
    }
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("it holds {}{more}", names.join(", "))
}
