//! Which six joints are the arm?

use std::collections::{BTreeSet, HashMap};

use super::urdf::{Joint, Kind, Urdf};
use crate::catalogue::reader::{Log, shown};
use crate::spatial::Pose;

/// The way from the base to the sixth moving link; fixed joints are merged into what follows them.
#[derive(Debug)]
pub(super) struct Chain {
    /// The link whose frame is the base frame.
    pub(super) base: String,
    /// The six joints; each `origin` stands in the frame that the joint before it moves.
    pub(super) joints: [Joint; 6],
    /// The sixth moving link and all that is fixed to it, with their frames in the frame of that link.
    pub(super) ends: Vec<(String, Pose)>,
    /// What a reader should know.
    pub(super) notes: Vec<String>,
    /// Joint 3, where links beside the arm follow it.
    pub(super) elbow_followed: Option<String>,
}

impl Chain {
    /// The sixth moving link in the base frame at the joint angles `q`, rad: the URDF's own forward kinematics.
    pub(super) fn forward(&self, q: &[f64; 6]) -> Pose {
        self.frames_at(q)[5]
    }

    /// What each of the six joints moves, in the base frame at the joint angles `q`, rad.
    pub(super) fn frames_at(&self, q: &[f64; 6]) -> [Pose; 6] {
        let mut pose = Pose::identity();
        std::array::from_fn(|i| {
            let joint = &self.joints[i];
            pose *= joint.origin * Pose::rotation(joint.axis.into_inner() * q[i]);
            pose
        })
    }

    /// The frame of every joint in the base frame, all joints at zero.
    pub(super) fn frames(&self) -> [Pose; 6] {
        let mut pose = Pose::identity();
        self.joints.each_ref().map(|joint| {
            pose *= joint.origin;
            pose
        })
    }
}

/// Where the arm begins and ends, where the user says so.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between<'a> {
    pub(super) base: Option<&'a str>,
    pub(super) tip: Option<&'a str>,
}

/// Why there is no chain; the log says which joints and links.
#[derive(Debug)]
pub(super) enum NoChain {
    /// The links and joints are no tree.
    Tree,
    /// It has another number of axes, or slides.
    Class,
    /// There are several arms, or no link of the name that was given.
    Which,
}

/// Finds the six joints between base and flange; faults go to the log.
pub(super) fn find(urdf: &Urdf, between: Between, log: &Log) -> Result<Chain, NoChain> {
    let tree = Tree::of(urdf, log).ok_or(NoChain::Tree)?;
    let base = tree.link(between.base, log)?.unwrap_or(tree.root);
    let last = match tree.link(between.tip, log)? {
        Some(tip) => tip,
        None => tree.sixth_link(base, log)?,
    };
    let way = tree.way(base, last).ok_or_else(|| {
        log.add(tree.place(last), "", format!("link '{}' is not carried by link '{}'", shown(last), shown(base)));
        NoChain::Which
    })?;
    // A robot that stands on something begins at its own base.
    let first = way.iter().position(|joint| joint.kind != Kind::Fixed).unwrap_or(0);
    let own = way.get(..=first).and_then(|way| way.iter().rposition(|joint| joint.parent.ends_with("base_link")));
    let way = if between.base.is_none() { &way[own.unwrap_or(0)..] } else { &way[..] };
    let base = way.first().map_or(base, |joint| &joint.parent);
    tree.chain(base, way, log)
}

/// Every name is there once, and every joint joins two links; else the log says which do not.
fn names_are_sound(urdf: &Urdf, log: &Log) -> bool {
    let (mut links, mut joints) = (BTreeSet::new(), BTreeSet::new());
    for link in &urdf.links {
        if !links.insert(link.name.as_str()) {
            log.add(link.place, &format!("link {}", shown(&link.name)), "there are two links of this name");
        }
    }
    for joint in &urdf.joints {
        if !joints.insert(joint.name.as_str()) {
            log.add(joint.place, &joint.key(), "there are two joints of this name");
        }
        for (part, link) in [("parent", &joint.parent), ("child", &joint.child)] {
            if !links.contains(link.as_str()) {
                log.add(joint.place, &joint.key(), format!("{part} '{}' is not the name of a link", shown(link)));
            }
        }
    }
    !log.has_faults()
}

/// The one link that no joint carries.
fn root<'a>(urdf: &'a Urdf, carrier: &HashMap<&str, &Joint>, log: &Log) -> Option<&'a str> {
    let roots: Vec<_> = urdf.links.iter().filter(|link| !carrier.contains_key(link.name.as_str())).collect();
    let (place, message) = match roots[..] {
        [root] => return Some(&root.name),
        [] if urdf.links.is_empty() => (0, "no link; expected a tree of links and joints".into()),
        [] => (0, "every link is the child of a joint: the joints form a ring; expected a tree".into()),
        [first, ..] => {
            let names: Vec<_> = roots.iter().take(4).map(|link| format!("'{}'", shown(&link.name))).collect();
            let more = if names.len() < roots.len() { ", ..." } else { "" };
            let names = names.join(", ");
            (first.place, format!("{} links are the child of no joint ({names}{more}); expected one root", roots.len()))
        }
    };
    log.add(place, "", message);
    None
}

/// Links and joints that were found to be a tree.
struct Tree<'a> {
    urdf: &'a Urdf,
    root: &'a str,
    /// The joint that carries a link.
    carrier: HashMap<&'a str, &'a Joint>,
    /// The joints that a link carries.
    carried: HashMap<&'a str, Vec<&'a Joint>>,
}

impl<'a> Tree<'a> {
    fn of(urdf: &'a Urdf, log: &Log) -> Option<Self> {
        names_are_sound(urdf, log).then_some(())?;
        let (mut carrier, mut carried) = (HashMap::new(), HashMap::<_, Vec<_>>::new());
        for joint in &urdf.joints {
            carried.entry(joint.parent.as_str()).or_default().push(joint);
            let before: Option<&Joint> = carrier.insert(joint.child.as_str(), joint);
            if let Some(before) = before {
                let (child, before) = (shown(&joint.child), shown(&before.name));
                let message = format!("link '{child}' is the child of joint '{before}' too; a URDF is a tree");
                log.add(joint.place, &joint.key(), message);
            }
        }
        if log.has_faults() {
            return None;
        }
        let root = root(urdf, &carrier, log)?;
        let tree = Self { urdf, root, carrier, carried };
        tree.rings(log)?;
        Some(tree)
    }

    /// Faults links that the root does not carry: they hang on each other in a ring.
    fn rings(&self, log: &Log) -> Option<()> {
        let reached: BTreeSet<&str> = self.below(self.root).map(|(link, _)| link).collect();
        let lost = self.urdf.links.iter().find(|link| !reached.contains(link.name.as_str()));
        match lost {
            None => Some(()),
            Some(link) => {
                let message = format!("is not carried by the root '{}': the joints form a ring", shown(self.root));
                log.add(link.place, &format!("link {}", shown(&link.name)), message);
                None
            }
        }
    }

    /// Every link that `base` carries, itself included, with the number of driven joints between them.
    fn below(&self, base: &'a str) -> impl Iterator<Item = (&'a str, usize)> {
        let mut found = vec![(base, 0)];
        let mut next = 0;
        while let Some(&(link, driven)) = found.get(next) {
            next += 1;
            let joints = self.carried.get(link).into_iter().flatten();
            found.extend(joints.map(|joint| (joint.child.as_str(), driven + usize::from(joint.is_driven()))));
        }
        found.into_iter()
    }

    /// The link that the user named.
    fn link(&self, name: Option<&str>, log: &Log) -> Result<Option<&'a str>, NoChain> {
        let Some(name) = name else { return Ok(None) };
        let found = self.urdf.links.iter().find(|link| link.name == name);
        if found.is_none() {
            let near = self.urdf.links.iter().map(|link| (crate::plain::alike(&link.name, name), &link.name));
            let near = near.max_by(|a, b| a.0.total_cmp(&b.0)).map_or("", |(_, near)| near);
            log.add(0, "", format!("no link is named '{}'; did you mean '{}'?", shown(name), shown(near)));
        }
        found.map(|link| Some(link.name.as_str())).ok_or(NoChain::Which)
    }

    fn place(&self, link: &str) -> usize {
        self.urdf.links.iter().find(|found| found.name == link).map_or(0, |link| link.place)
    }

    /// The one link that a sixth driven joint moves, and that carries no seventh.
    fn sixth_link(&self, base: &'a str, log: &Log) -> Result<&'a str, NoChain> {
        let below: Vec<_> = self.below(base).collect();
        let moved = |count| {
            let driven = |link: &str| self.carrier.get(link).is_some_and(|joint| joint.is_driven());
            below.iter().filter(move |&&(link, n)| n == count && link != base && driven(link)).map(|&(link, _)| link)
        };
        let sixth: Vec<&str> = moved(6).collect();
        let [last] = sixth[..] else {
            return Err(self.no_sixth(&below, &sixth, base, log));
        };
        match moved(7).next() {
            None => Ok(last),
            Some(seventh) => {
                let joint = self.carrier[seventh];
                log.add(joint.place, &joint.key(), "a seventh axis; expected six between base and flange");
                Err(NoChain::Class)
            }
        }
    }

    fn no_sixth(&self, below: &[(&str, usize)], sixth: &[&str], base: &str, log: &Log) -> NoChain {
        if sixth.is_empty() {
            let most = below.iter().map(|&(_, driven)| driven).max().unwrap_or(0);
            let sliding = self.urdf.joints.iter().find(|joint| matches!(joint.kind, Kind::Sliding(_)));
            let sliding =
                sliding.map_or_else(String::new, |joint| format!(", and joint '{}' slides", shown(&joint.name)));
            let message =
                format!("{most} joints turn one after the other from link '{}' on{sliding}; expected six", shown(base));
            log.add(self.place(base), "", message);
            return NoChain::Class;
        }
        let names: Vec<_> = sixth.iter().take(4).map(|link| format!("'{}'", shown(link))).collect();
        let message =
            format!("several arms: the links {} are each moved by a sixth joint; expected one", names.join(", "));
        log.add(self.place(sixth[0]), "", message);
        NoChain::Which
    }

    /// The joints from `base` to `last`.
    fn way(&self, base: &str, last: &'a str) -> Option<Vec<&'a Joint>> {
        let mut way = Vec::new();
        let mut link = last;
        while link != base {
            let joint = self.carrier.get(link)?;
            way.push(*joint);
            link = &joint.parent;
        }
        way.reverse();
        Some(way)
    }

    fn chain(&self, base: &str, way: &[&'a Joint], log: &Log) -> Result<Chain, NoChain> {
        let mut sound = true;
        for joint in way {
            let message = match (&joint.kind, &joint.mimic) {
                (Kind::Sliding(kind), _) => format!("a {kind} joint between base and flange; expected six that turn"),
                (Kind::Fixed, _) | (_, None) => continue,
                (_, Some(other)) => {
                    format!(
                        "follows joint '{}' between base and flange; expected six drives of their own",
                        shown(other)
                    )
                }
            };
            log.add(joint.place, &joint.key(), message);
            sound = false;
        }
        let driven = way.iter().filter(|joint| joint.is_driven()).count();
        if driven != 6 {
            let last = way.last().map_or(base, |joint| &joint.child);
            let message =
                format!("{driven} joints turn between the links '{}' and '{}'; expected six", shown(base), shown(last));
            log.add(self.place(base), "", message);
            sound = false;
        }
        if !sound {
            return Err(NoChain::Class);
        }
        let mut merged = Pose::identity();
        let mut joints: Vec<Joint> = Vec::new();
        for joint in way {
            merged *= joint.origin;
            if joint.is_driven() {
                joints.push(Joint { origin: merged, ..(*joint).clone() });
                merged = Pose::identity();
            }
        }
        let joints: [Joint; 6] = joints.try_into().map_err(|_| NoChain::Class)?;
        let ends = self.fixed_to(&joints[5].child);
        let notes = self.left_out(way, &joints);
        let elbow_followed = self.is_followed(&joints[2]).then(|| shown(&joints[2].name));
        Ok(Chain { base: base.into(), joints, ends, notes, elbow_followed })
    }

    /// A link and all that is fixed to it, in its frame.
    fn fixed_to(&self, link: &str) -> Vec<(String, Pose)> {
        let mut found = vec![(link.to_owned(), Pose::identity())];
        let mut next = 0;
        while let Some((link, pose)) = found.get(next).cloned() {
            next += 1;
            let joints = self.carried.get(link.as_str()).into_iter().flatten();
            let fixed = joints.filter(|joint| joint.kind == Kind::Fixed);
            found.extend(fixed.map(|joint| (joint.child.clone(), pose * joint.origin)));
        }
        found
    }

    /// Do links beside the arm follow this joint of it?
    fn is_followed(&self, joint: &Joint) -> bool {
        self.urdf.joints.iter().any(|other| other.kind != Kind::Fixed && other.mimic.as_deref() == Some(&joint.name))
    }

    /// What the joints that are not on the way may mean.
    fn left_out(&self, way: &[&Joint], arm: &[Joint; 6]) -> Vec<String> {
        let others = self.urdf.joints.iter().filter(|joint| joint.kind != Kind::Fixed);
        let others: Vec<_> = others.filter(|joint| !way.iter().any(|on_it| std::ptr::eq(*on_it, *joint))).collect();
        let mut notes = Vec::new();
        let names: Vec<_> = others.iter().take(8).map(|joint| shown(&joint.name)).collect();
        if !names.is_empty() {
            let more = if names.len() < others.len() { ", ..." } else { "" };
            notes.push(format!("left out, not between base and flange: joints {}{more}", names.join(", ")));
        }
        if !self.is_followed(&arm[2]) && self.is_followed(&arm[1]) {
            notes.push(format!(
                "links follow joint {}: a gravity compensator, perhaps; a robot file can say it",
                shown(&arm[1].name)
            ));
        }
        notes
    }
}
