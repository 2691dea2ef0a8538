use stiffarm::{catalogue::*,place::*,task::*,study::*};
fn main(){
 let t=std::time::Instant::now();
 let s=study(&StudyOptions::paper()).unwrap(); println!("study {:?}",t.elapsed());
 for b in &s.boundaries {println!("{b:?}");}
 let robots=paper_robots();
 let t=std::time::Instant::now();
 for r in &robots { print!("{:20} {:10}",r.name,r.status); print!(" floor {:.3} ", r.arm_plane().unwrap().arm.radial().floor()*1e6);
  for l in ["A:0.1","A:1.0","B:0.1","B:0.5","C:0.05","C:0.15"] { let t=std::time::Instant::now(); let p=place_robot(r,l.parse::<Task>().unwrap().zone,&PlaceOptions::paper(1000.)); let ms=t.elapsed().as_secs_f64()*1e3; match p.unwrap() {Placed::Feasible(p)=>print!(" {:.3}({:.1e} {:.2}ms {:.2},{:.2} {})",p.deflection*1e3,1.-p.lower_bound/p.deflection,ms,p.centre[0],p.centre[1],p.elbow.name()),Placed::Infeasible{largest_scale,..}=>print!(" - {largest_scale:.3} {ms:.2}ms")}} println!(); }
 println!("{:?}",t.elapsed());
}
