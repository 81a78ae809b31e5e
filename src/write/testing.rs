//! For tests: an awkward mesh, and readers that share no code with the writers.

use crate::kernel::frame::Frame;
use crate::model::{Part, Tin};
use glam::{DVec2, DVec3};

/// Vertices as bits, faces as part and 0-based corners.
pub(crate) type Raw = (Vec<[u64; 3]>, Vec<(u8, [u32; 3])>);

/// A grid of `n` × `n` squares far from zero with heights of every magnitude, parts taking turns.
pub(crate) fn awkward_tin(n: u32) -> Tin {
    let min = DVec2::new(500_000.123, 4_649_776.22);
    let frame = Frame::around(min, min + f64::from(n));
    let mut tin = Tin { frame, vertices: Vec::new(), triangles: Vec::new(), parts: Vec::new() };
    for i in 0..=n {
        for j in 0..=n {
            let k = f64::from(i * (n + 1) + j);
            let plan = min + DVec2::new(f64::from(i), f64::from(j)) * (1.0 / 3.0) + (k * 0.7).sin() * 1e-3;
            let z = (k * 1.3).cos() * 10_f64.powi((k % 600.0) as i32 - 300);
            tin.vertices.push(frame.to_local(DVec3::new(plan.x, plan.y, z)));
        }
    }
    for i in 0..n {
        for j in 0..n {
            let a = i * (n + 1) + j;
            let b = a + n + 1;
            tin.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            tin.parts.extend([Part::ALL[(j % 4) as usize], Part::ALL[(i % 3) as usize]]);
        }
    }
    tin
}

/// Reads OBJ text of the kind `write_obj` makes.
pub(crate) fn read_obj(bytes: &[u8]) -> Raw {
    let (mut vertices, mut faces, mut part) = (Vec::new(), Vec::new(), 255);
    for line in std::str::from_utf8(bytes).unwrap().lines() {
        let words: Vec<&str> = line.split(' ').collect();
        match words[0] {
            "v" => vertices.push([1, 2, 3].map(|i| words[i].parse::<f64>().unwrap().to_bits())),
            "f" => faces.push((part, [1, 2, 3].map(|i| words[i].parse::<u32>().unwrap() - 1))),
            "g" => part = ["platform", "fill_slope", "cut_slope", "ground"].iter().position(|n| *n == words[1]).unwrap() as u8,
            "#" => {}
            other => panic!("unexpected `{other}`"),
        }
    }
    (vertices, faces)
}

/// Reads binary PLY with exactly the properties `write_ply` declares, counts taken from the header.
pub(crate) fn read_ply(bytes: &[u8]) -> Raw {
    let end = b"end_header\n";
    let head = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let text = std::str::from_utf8(&bytes[..head]).unwrap();
    let count = |name: &str| -> usize {
        let line = text.lines().find_map(|l| l.strip_prefix(&format!("element {name} "))).unwrap();
        line.parse().unwrap()
    };
    let properties: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix("property ")).collect();
    assert_eq!(properties, ["double x", "double y", "double z", "list uchar int vertex_indices", "uchar part"]);
    let mut rest = &bytes[head..];
    let mut take = |n: usize| -> &[u8] {
        let (front, back) = rest.split_at(n);
        rest = back;
        front
    };
    let vertices = (0..count("vertex")).map(|_| [0; 3].map(|_: u8| u64::from_le_bytes(take(8).try_into().unwrap()))).collect();
    let faces = (0..count("face"))
        .map(|_| {
            assert_eq!(take(1), [3]);
            let corners = [0; 3].map(|_: u8| u32::from_le_bytes(take(4).try_into().unwrap()));
            (take(1)[0], corners)
        })
        .collect();
    assert!(rest.is_empty());
    (vertices, faces)
}
