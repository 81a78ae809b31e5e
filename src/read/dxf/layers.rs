//! Layers: which are meant, and what they hold.

use super::names::{counted, decode, key, listed};
use crate::read::ReadError;
use crate::read::error::refuse;
use rustc_hash::FxHashMap;

/// A number of [`Layers`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct LayerId(u32);

/// What there is on a layer, in model space.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Census {
    pub(super) lines: usize,
    pub(super) faces: usize,
    pub(super) points: usize,
    /// Entities of kinds that are not read.
    pub(super) others: usize,
}

struct Layer {
    name: String,
    off: bool,
    frozen: bool,
    named: bool,
    census: Census,
}

/// All layers, those without an entry in the table of layers, too.
pub(super) struct Layers<'a> {
    list: Vec<Layer>,
    by_key: FxHashMap<String, LayerId>,
    /// The one asked for last, as entities of one layer stand together.
    last: Option<(&'a [u8], LayerId)>,
    /// Names asked for, and their keys.
    wanted: Vec<(String, String)>,
}

impl<'a> Layers<'a> {
    pub(super) fn new(wanted: &[String]) -> Self {
        let wanted = wanted.iter().map(|name| (name.clone(), key(name))).collect();
        Self { list: Vec::new(), by_key: FxHashMap::default(), last: None, wanted }
    }

    /// The layer of a name as it stands in the file.
    pub(super) fn id(&mut self, raw: &'a [u8]) -> LayerId {
        if let Some((last, id)) = self.last
            && last == raw
        {
            return id;
        }
        let name = decode(raw);
        let key = key(&name);
        let id = match self.by_key.get(&key) {
            Some(&id) => id,
            None => {
                let id = LayerId(self.list.len() as u32);
                let named = self.wanted.iter().any(|(_, wanted)| *wanted == key);
                self.list.push(Layer { name, off: false, frozen: false, named, census: Census::default() });
                self.by_key.insert(key, id);
                id
            }
        };
        self.last = Some((raw, id));
        id
    }

    /// Notes what the table of layers says of one.
    pub(super) fn declare(&mut self, raw: &'a [u8], off: bool, frozen: bool) {
        let LayerId(at) = self.id(raw);
        if let Some(layer) = self.list.get_mut(at as usize) {
            (layer.off, layer.frozen) = (off, frozen);
        }
    }

    fn get(&self, LayerId(at): LayerId) -> Option<&Layer> {
        self.list.get(at as usize)
    }

    pub(super) fn name(&self, id: LayerId) -> &str {
        self.get(id).map_or("", |layer| &layer.name)
    }

    pub(super) fn frozen(&self, id: LayerId) -> bool {
        self.get(id).is_some_and(|layer| layer.frozen)
    }

    /// Whether what is on the layer is meant: by name, else where it is on.
    pub(super) fn meant(&self, id: LayerId) -> bool {
        let meant = |layer: &Layer| if self.wanted.is_empty() { !layer.off && !layer.frozen } else { layer.named };
        self.get(id).is_none_or(meant)
    }

    /// Whether layers were asked for by name.
    pub(super) fn chosen(&self) -> bool {
        !self.wanted.is_empty()
    }

    pub(super) fn census(&mut self, LayerId(at): LayerId) -> Option<&mut Census> {
        self.list.get_mut(at as usize).map(|layer| &mut layer.census)
    }

    /// # Errors
    /// A layer was asked for that is not there.
    pub(super) fn check(&self, label: &str) -> Result<(), ReadError> {
        match self.wanted.iter().find(|(_, key)| !self.by_key.contains_key(key)) {
            Some((name, _)) => {
                let help = "give the name of one of these layers";
                Err(refuse(&format!("the drawing has no layer `{name}`"), label, self.holdings(), help))
            }
            None => Ok(()),
        }
    }

    /// What each layer holds, in words.
    pub(super) fn holdings(&self) -> String {
        let holding = |layer: &Layer| {
            let state = match (layer.frozen, layer.off) {
                (true, _) => " (frozen)",
                (false, true) => " (off)",
                (false, false) => "",
            };
            let Census { lines, faces, points, others } = layer.census;
            let counts = [
                (lines, "line", "lines"),
                (faces, "face", "faces"),
                (points, "point", "points"),
                (others, "other entity", "other entities"),
            ];
            let counts: Vec<_> = counts.iter().filter(|c| c.0 > 0).map(|&(n, one, many)| counted(n, one, many)).collect();
            format!("`{}`{state}: {}", layer.name, counts.join(", "))
        };
        let filled = |layer: &&Layer| {
            let Census { lines, faces, points, others } = layer.census;
            lines + faces + points + others > 0
        };
        let text = listed(self.list.iter().filter(filled).map(holding));
        if text.is_empty() { "its model space is empty".into() } else { text }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_name_or_by_state() {
        let declare = |wanted: &[String]| {
            let mut layers = Layers::new(wanted);
            layers.declare(b"Achse", false, false);
            layers.declare(b"ALT", true, false);
            layers.declare(b"Schrift", false, true);
            let ids = [&b"ACHSE"[..], b"alt", b"Schrift", b"neu"].map(|name| layers.id(name));
            for id in ids {
                layers.census(id).unwrap().lines += 1;
            }
            layers.census(ids[3]).unwrap().points += 2;
            (ids.map(|id| layers.meant(id)), layers.check("a.dxf").map_err(|e| e.to_string()))
        };
        assert_eq!(declare(&[]), ([true, false, false, true], Ok(())));
        assert_eq!(declare(&["aLT".into(), "NEU".into()]), ([false, true, false, true], Ok(())));
        let error = declare(&["axis".into()]).1.unwrap_err();
        let wanted = "`Achse`: 1 line; `ALT` (off): 1 line; `Schrift` (frozen): 1 line; `neu`: 1 line, 2 points";
        assert!(error.contains(wanted) && error.contains("no layer `axis`"), "{error}");
    }
}
