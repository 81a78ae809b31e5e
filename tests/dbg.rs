mod common;
use common::lines::case;
use glam::DVec3;
use slopegen::model::*;
use slopegen::slope::{arcs::Arcs, closure, fan::Fans, network::Network, trim};
#[test]
fn dbg() {
    let seed: u64 = std::env::var("S").unwrap().parse().unwrap();
    let size: usize = std::env::var("Z").unwrap().parse().unwrap();
    let depth: f64 = std::env::var("D").unwrap().parse().unwrap();
    let rising = std::env::var("R").is_ok();
    let c = case(seed, size);
    let line = if std::env::var("X3").is_ok() {
        let ch = |v: Vec<(f64, f64, f64)>| Chain {
            name: "x".into(),
            role: Role::Open,
            places: vec![Place::default(); v.len()],
            vertices: v.into_iter().map(DVec3::from).collect(),
        };
        Line {
            chains: vec![ch(vec![(1000., 1050., 10.), (1100., 1050., 10.)]), ch(vec![(1040., 1010., 13.), (1040., 1100., 13.)])],
        }
    } else {
        Line {
            chains: c
                .lines
                .iter()
                .map(|l| Chain {
                    name: "x".into(),
                    role: if l.closed { Role::Outer { polygon: 0 } } else { Role::Open },
                    vertices: l.points.iter().map(|&p| DVec3::from(p)).collect(),
                    places: vec![Place::default(); l.points.len()],
                })
                .collect(),
        }
    };
    let k = if std::env::var("X3").is_ok() { 0.5 } else { c.k };
    let d = Design {
        slope: Slope::from_ratio(k).unwrap(),
        sheet: if rising { Sheet::Rising } else { Sheet::Falling },
        side_of_lines: Side::Both,
        side_of_rings: Side::Both,
        extent: Extent::Height(depth),
        interval: None,
        tolerance: 0.01,
    };
    let net = Network::new(&line, &d, 0.0033);
    let fans = Fans::new(&net, k);
    let index = trim::index_of(&net, k);
    let bottom = net.nodes.iter().map(|p| p.z).fold(f64::MAX, f64::min);
    let end = if std::env::var("X3").is_ok() { 8.0 } else { bottom - depth - 1e-3 * depth.max(1.0) };
    let sheet = trim::Sheet::new(&net, &fans, &index, k, end);
    let cl = closure::close(&sheet, closure::Scope::Wanted, &[]);
    let arcs = Arcs::new(&sheet, &cl);
    println!("edges {} unpaired {} stuck {:?} end {end}", net.edges.len(), arcs.unpaired.len(), cl.stuck);
    let nm = |f: u32| if f == u32::MAX { "E".to_string() } else { f.to_string() };
    let mut fs: Vec<u32> =
        arcs.unpaired.iter().flat_map(|&u| [arcs.arcs[u as usize].owner, arcs.arcs[u as usize].partner]).collect();
    fs.extend(&cl.stuck);
    if std::env::var("X3").is_ok() {
        fs = (0..fans.facets.len() as u32).collect();
    }
    fs.sort();
    fs.dedup();
    for &u in &arcs.unpaired {
        let a = &arcs.arcs[u as usize];
        println!("   UNP {}-{} {:?}", nm(a.owner), nm(a.partner), a.ends);
    }
    for f in fs {
        print!("  f{f} {:?} L{:?}:", fans.facets[f as usize].kind, fans.facets[f as usize].lateral);
        for k in &cl.knots[f as usize] {
            print!(" {}|{} v{}@{:.6}", nm(k.left), nm(k.right), k.vertex, k.tau);
        }
        println!();
        for k in &cl.knots[f as usize] {
            let p = cl.vertices[k.vertex as usize];
            println!(
                "     v{} {:.9} {:.9} {:.9} {:?} f={:.9}",
                k.vertex,
                p.x,
                p.y,
                p.z,
                cl.keys[k.vertex as usize],
                index.height(p.truncate(), None).0
            );
        }
    }
}
