use slopegen::model::*;
use slopegen::slope::{arcs::Arcs, closure, fan::Fans, network::Network, trim};
use glam::DVec3;

struct Rng(u64);
impl Rng { fn f(&mut self)->f64{ self.0=self.0.wrapping_add(0x9E3779B97F4A7C15); let mut z=self.0; z=(z^(z>>30)).wrapping_mul(0xBF58476D1CE4E5B9); z=(z^(z>>27)).wrapping_mul(0x94D049BB133111EB); ((z^(z>>31))>>11) as f64/(1u64<<53) as f64}
 fn b(&mut self,a:f64,b:f64)->f64{a+(b-a)*self.f()} }

fn chain(role: Role, v: Vec<DVec3>) -> Chain { Chain{name:"x".into(), role, places: vec![Place::default(); v.len()], vertices: v} }
fn star(n:usize, amp:f64, zamp:f64, noise:f64, r:&mut Rng)->Chain{
  let ph:Vec<f64>=(0..8).map(|_|r.b(0.0,6.28)).collect();
  chain(Role::Outer{polygon:0},(0..n).map(|i|{let t=i as f64/n as f64*std::f64::consts::TAU; let mut rad=100.0; let mut z=0.0; for j in 0..4{rad+=amp*100.0/4.0*((j as f64*2.0+3.0)*t+ph[j]).sin(); z+=zamp/4.0*((j as f64+1.0)*t+ph[j+4]).sin();} rad+=r.b(-noise,noise); DVec3::new(rad*t.cos(),rad*t.sin(),z)}).collect())
}
fn walk(n:usize, g:f64, step:f64, turn:f64, r:&mut Rng)->Chain{
  let mut p=DVec3::ZERO; let mut a=0.0; let mut v=vec![p];
  for _ in 1..n{ a+=r.b(-turn,turn); let l=r.b(0.2,1.0)*step; p+=DVec3::new(l*f64::cos(a),l*f64::sin(a),l*r.b(-g,g)); v.push(p);}
  chain(Role::Open,v)
}
fn run(name:&str, line:&Line, k:f64, side:Side, depth:f64, eps:f64)->(usize,usize){
  let d=Design{slope:Slope::from_ratio(k).unwrap(),sheet:Sheet::Falling,side_of_lines:Side::Both,side_of_rings:side,extent:Extent::Elevation(-depth),interval:None,tolerance:0.01};
  let t0=std::time::Instant::now();
  let net=Network::new(line,&d,eps);
  let fans=Fans::new(&net,k);
  let index=trim::index_of(&net,k);
  let t1=std::time::Instant::now();
  let sheet=trim::Sheet::new(&net,&fans,&index,k,line.elevation_range().0-depth);
  let c=closure::close(&sheet,closure::Scope::Wanted,&[]);
  let t2=std::time::Instant::now();
  let arcs=Arcs::new(&sheet,&c);
  let t3=std::time::Instant::now();
  let top=line.elevation_range().1; let end=line.elevation_range().0-depth;
  let levels=slopegen::slope::levels::Levels::between(end,top,slopegen::slope::levels::round_interval(top-end));
  let cut=slopegen::slope::refine::Cut{levels:&levels,chord:0.003,reach:None};
  let sl=if arcs.unpaired.is_empty()&&c.stuck.is_empty() {slopegen::slope::emit::emit(&sheet,&c,&arcs,&cut)} else {Default::default()};
  let t4=std::time::Instant::now();
  let mut used=std::collections::HashMap::new(); let mut bad=0; let mut worst=[0f64;2]; let mut herr=0f64; let mut w=0;
  for (i,t) in sl.triangles.iter().enumerate(){ let p=t.map(|v|sl.points[v as usize]); let n=(p[1]-p[0]).cross(p[2]-p[0]); if n.z<=0.0 {bad+=1;continue} for e in [(t[0],t[1]),(t[1],t[2]),(t[2],t[0])]{*used.entry(e).or_insert(0)+=1;}
    let ht=p.iter().map(|q|q.z).fold(f64::MIN,f64::max)-p.iter().map(|q|q.z).fold(f64::MAX,f64::min); if ht>1e-4 { let d=((n.truncate().length()/n.z).atan()-k.atan()).to_degrees().abs(); let o=sl.on_cone[i] as usize; worst[o]=worst[o].max(d);}
    if i%7==0 { let m=(p[0]+p[1]+p[2])/3.0; herr=herr.max((index.height(m.truncate(),None).0-m.z).abs()); for q in p { w+=1; herr=herr.max((index.height(q.truncate(),None).0-q.z).abs());} } }
  let dup=used.values().filter(|&&c|c>1).count(); let bnd=used.keys().filter(|e|!used.contains_key(&(e.1,e.0))).count();
  // boundary edges must be traced as hinge or boundary
  let tr:std::collections::HashSet<(u32,u32)>=sl.traces.iter().filter(|t|matches!(t.0,slopegen::slope::emit::Trace::Hinge|slopegen::slope::emit::Trace::Boundary)).flat_map(|t|[(t.1[0],t.1[1]),(t.1[1],t.1[0])]).collect();
  let crack=used.keys().filter(|e|!used.contains_key(&(e.1,e.0))&&!tr.contains(e)).count();
  let lost=sl.traces.iter().filter(|t|!used.contains_key(&(t.1[0],t.1[1]))&&!used.contains_key(&(t.1[1],t.1[0]))).count();
  let _=w; if bad+dup+crack+lost+sl.failed.len()>0 || worst[0]>0.01||worst[1]>0.1||herr>0.004||name.starts_with('!') { println!("  EMIT {name}: T {} V {} bad {bad} dup {dup} bnd {bnd} crack {crack} lost {lost} failed {} slope {worst:?} herr {herr:.2e} emit {:?}", sl.triangles.len(), sl.points.len(), sl.failed.len(), t4-t3); }
  if net.edges.len()<12 { for &f in &sl.failed { let nm=|f:u32| if f==u32::MAX {"E".to_string()} else {f.to_string()}; let fc=&fans.facets[f as usize]; println!("   FAILED f{f} {:?} L{:?} tau_max {} g {}", fc.kind, fc.lateral, fc.tau_max, fc.gamma); for k in &c.knots[f as usize] { println!("      {}|{} v{}@{:.6} {:?}", nm(k.left),nm(k.right),k.vertex,k.tau,c.vertices[k.vertex as usize]);} let bp=sl.points.iter().position(|p|!p.is_finite()); println!("   nonfinite {bp:?} nclosure {} ", c.vertices.len()); for (i,q) in sl.points.iter().enumerate().skip(c.vertices.len()).take(0){ println!("{i} {q}"); } } }
  if !arcs.unpaired.is_empty()||!c.stuck.is_empty()||name.starts_with('!') {
  println!("{name}: edges {} facets {} verts {} arcs {} unpaired {} stuck {} strangers {} | net {:?} close {:?} pair {:?}", net.edges.len(), fans.facets.len(), c.vertices.len(), arcs.arcs.len(), arcs.unpaired.len(), c.stuck.len(), c.strangers, t1-t0,t2-t1,t3-t2);
  if net.edges.len()<=std::env::var("V").ok().and_then(|v|v.parse().ok()).unwrap_or(0) {
    let nm=|f:u32| if f==u32::MAX {"E".to_string()} else {f.to_string()};
    for (f,kn) in c.knots.iter().enumerate() { if kn.is_empty(){continue} print!("  f{f} {:?} L{:?}:", fans.facets[f].kind, fans.facets[f].lateral); for k in kn { print!(" {}|{} v{}@{:.3}", nm(k.left),nm(k.right),k.vertex,k.tau);} println!(); }
    for (v,p) in c.vertices.iter().enumerate() { println!("  v{v} {:.4} {:.4} {:.4} {:?}", p.x,p.y,p.z,c.keys[v]); }
    for &u in &arcs.unpaired { let a=&arcs.arcs[u as usize]; println!("   UNP {}-{} {:?}", nm(a.owner),nm(a.partner), a.ends);}
  }
  }
  (arcs.unpaired.len(), c.stuck.len())
}
#[test] fn scratch(){
  let mut r=Rng(1);
  let sq=|s:f64,z:f64|Line{chains:vec![chain(Role::Outer{polygon:0},vec![DVec3::new(0.,0.,z),DVec3::new(s,0.,z),DVec3::new(s,s,z),DVec3::new(0.,s,z)])]};
  run("!square out",&sq(40.,0.),0.5,Side::Outside,10.,1e-9);
  run("!square in",&sq(40.,0.),0.5,Side::Inside,30.,1e-9);
  run("!square both",&sq(40.,0.),0.5,Side::Both,30.,1e-9);
  run("!seg",&Line{chains:vec![chain(Role::Open,vec![DVec3::ZERO,DVec3::new(10.,0.,2.)])]},0.5,Side::Both,10.,1e-9);
  let mut tot=(0,0,0);
  for i in 0..200 { let l=Line{chains:vec![star(5+(r.f()*60.0) as usize,0.5,3.0,0.0,&mut r)]}; let x=run(&format!("star{i}"),&l,0.5,Side::Both,15.,1e-9); tot.0+= (x.0>0) as i32; tot.1+=(x.1>0) as i32; tot.2+=1;}
  println!("star {tot:?}"); tot=(0,0,0);
  for g in [0.3,0.9,0.98] { for i in 0..200 { let n=5+(r.f()*60.0) as usize; let l=Line{chains:vec![walk(n,g*0.5,10.0,0.6,&mut r)]}; let x=run(&format!("walk{g} {i}"),&l,0.5,Side::Both,15.,1e-9); tot.0+= (x.0>0) as i32; tot.1+=(x.1>0) as i32; tot.2+=1;}
  println!("walk {g} {tot:?}"); tot=(0,0,0);}
  for i in 0..200 { let m=2+(r.f()*6.0) as usize; let l=Line{chains:(0..m).map(|j|{let o=DVec3::new(r.b(-60.,60.),r.b(-60.,60.),r.b(-5.,5.)); let mut c= if j%2==0 {star(5+(r.f()*9.0) as usize,0.3,1.0,0.0,&mut r)} else {walk(3,0.1,20.0,0.5,&mut r)}; for v in &mut c.vertices { let s=if j%2==0 {0.15} else {1.0}; v.x*=s;v.y*=s; *v+=o;} c}).collect()}; let x=run(&format!("isl{i}"),&l,0.5,Side::Both,15.,1e-9); tot.0+= (x.0>0) as i32; tot.1+=(x.1>0) as i32; tot.2+=1;}
  println!("islands {tot:?}");
  for (n,noise,eps) in [(1000,0.0,1e-9),(1000,0.02,1e-9),(1000,0.0,3e-3),(10000,0.0,1e-9),(10000,0.0,1e-4),(10000,0.02,3e-3),(10000,0.02,1e-9),(100000,0.0,1e-4),(100000,0.0,3e-3),(100000,0.02,3e-3)] {
    if n>10000 && std::env::var("BIG").is_err() {continue}
    let l=Line{chains:vec![star(n,0.5,3.0,noise,&mut r)]}; run(&format!("!big star {n} {noise} {eps}"),&l,0.5,Side::Outside,15.,eps);
  }
}
