#![allow(warnings, clippy::all, clippy::pedantic)]
#[path="../tests/motions/common.rs"] mod common;
use trunnion_interp::*; use trunnion_machine::*; use std::time::Instant;
fn main(){
  let m=builtin("mikron-ucp710").unwrap();
  let n=200_000usize; let mut motions=Vec::with_capacity(n);
  let mut start=Position::default(); let (mut y,mut d)=(0.0,1i64); let mut cprev=0.0f64;
  'o: loop { for k in 0..2000i64 { if motions.len()>=n {break 'o;}
    let x=(if d>0 {k} else {1999-k}) as f64*0.05;
    let z=5.0*(x/17.0).sin()*(y/13.0f64).cos(); let zx=5.0/17.0*(x/17.0).cos()*(y/13.0f64).cos(); let zy=-5.0/13.0*(x/17.0).sin()*(y/13.0f64).sin();
    let l=(zx*zx+zy*zy+1.0f64).sqrt(); let a=(1.0/l).acos().to_degrees(); let mut c=(-zx).atan2(zy).to_degrees();
    while c-cprev>180.0 {c-=360.0} while c-cprev< -180.0 {c+=360.0} cprev=c;
    let r=|v:f64|(v*1e4).round()/1e4;
    let end=common::position(&[(b'X',r(x)),(b'Y',r(y)),(b'Z',r(z)),(b'A',r(a)),(b'C',r(c))]);
    motions.push(common::words(start,end)); start=end; } y+=0.2; d=-d; }
  for mode in 0..3 {
    let ms:Vec<Motion>=motions.iter().map(|m| { let mut m=*m; if mode>=1 {m.tcp=true} m }).collect();
    for what in 0..6 {
      if mode==2 && what>0 {break}
      let mut best=f64::MAX; let mut sum=0.0; let mut cnt=0;
      for _ in 0..3 { let mut f=Follower::new(m); let t=Instant::now(); cnt=0; let mut out=Vec::new();
        for mo in &ms { let leg=f.follow(mo); sum+=leg.length;
          match what { 0=>{}, 1=>{ if let Some(d)=tip_deviation(m,&leg,0.01){ sum+=d.bound_mm; if d.bound_mm>0.01 {cnt+=1} } },
           2=>{ if let Some(d)=feed_limit(m,&leg){ sum+=d.feed_mm_min; if d.feed_mm_min<2000.0{cnt+=1} } }, 3=>{ limit_excess(m,&leg,&mut out); cnt=out.len() } , 4=>{ sum+=block_duration_s(m,&leg).unwrap_or(0.0)}, _=>{
             if let Some(d)=tip_deviation(m,&leg,0.01){ sum+=d.bound_mm} if let Some(d)=feed_limit(m,&leg){ sum+=d.feed_mm_min} limit_excess(m,&leg,&mut out); sum+=block_duration_s(m,&leg).unwrap_or(0.0) } } }
        best=best.min(t.elapsed().as_secs_f64()); }
      println!("mode {mode} what {what}: {:.1} ns/block  count {cnt} {}", best/n as f64*1e9, sum>0.0);
    } }
}
