//! Signals that end the program wait while a file gets its name: between its hidden and its own one it would be left behind.

/// Does `work`; who asks the program to end meanwhile is obeyed afterwards.
#[cfg(not(target_os = "linux"))]
pub(crate) fn waiting<R>(work: impl FnOnce() -> R) -> R {
    work()
}

#[cfg(target_os = "linux")]
pub(crate) use linux::waiting;

#[cfg(target_os = "linux")]
mod linux {
    use std::fs;
    use std::io;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::{Arc, LazyLock};

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::{flag, low_level};

    /// A signal that ends the program, and whether it came while it had to wait.
    struct Pending {
        signal: i32,
        came: Arc<AtomicBool>,
    }

    struct Signals {
        /// Nothing is in the way of an end.
        may_end: Arc<AtomicBool>,
        pending: Vec<Pending>,
    }

    static SIGNALS: LazyLock<io::Result<Signals>> = LazyLock::new(Signals::watched);

    /// Does `work`; who asks the program to end meanwhile is obeyed afterwards. Where signals cannot be watched they act at once, as ever.
    pub(crate) fn waiting<R>(work: impl FnOnce() -> R) -> R {
        let Ok(signals) = &*SIGNALS else { return work() };
        signals.may_end.store(false, Ordering::SeqCst);
        let done = work();
        signals.may_end.store(true, Ordering::SeqCst);
        for Pending { signal, came } in &signals.pending {
            if came.load(Ordering::SeqCst) {
                low_level::emulate_default_handler(*signal).expect("a signal that was registered");
            }
        }
        done
    }

    impl Signals {
        fn watched() -> io::Result<Self> {
            let ignored = ignored(&fs::read_to_string("/proc/self/status")?);
            let may_end = Arc::new(AtomicBool::new(true));
            let mut pending = Vec::new();
            // What the shell made the program ignore (nohup, a job in the background) stays ignored.
            for signal in [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored & (1 << (signal - 1)) == 0) {
                let came = Arc::new(AtomicBool::new(false));
                flag::register_conditional_default(signal, Arc::clone(&may_end))?;
                flag::register(signal, Arc::clone(&came))?;
                pending.push(Pending { signal, came });
            }
            Ok(Self { may_end, pending })
        }
    }

    /// The signals that were ignored when the program was started, a bit each from 1, as the kernel lists them; all where it does not say.
    fn ignored(status: &str) -> u64 {
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(u64::MAX)
    }

    #[cfg(test)]
    mod tests {
        use std::env;
        use std::os::unix::process::ExitStatusExt;
        use std::process::Command;

        use super::*;

        const FILE: &str = "STIFFARM_TEST_FILE";

        /// What [`a_signal_waits_until_the_work_is_done`] starts; alone it does nothing.
        #[test]
        fn is_asked_to_end_while_it_works() {
            let Some(path) = env::var_os(FILE) else { return };
            waiting(|| {
                low_level::raise(SIGTERM).unwrap();
                fs::write(&path, "whole").unwrap();
            });
            fs::write(&path, "went on").unwrap();
        }

        #[test]
        fn a_signal_waits_until_the_work_is_done() {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("file");
            let child = |run: &str| {
                let test = "signals::linux::tests::is_asked_to_end_while_it_works";
                let program = format!("{run} \"$0\" --exact {test}");
                let mut shell = Command::new("sh");
                let ended = shell.arg("-c").arg(program).arg(env::current_exe().unwrap()).env(FILE, &path).output();
                (ended.unwrap().status.signal(), fs::read_to_string(&path).unwrap())
            };
            assert_eq!(child("exec env --default-signal"), (Some(SIGTERM), "whole".into()));
            assert_eq!(child("trap '' TERM; exec"), (None, "went on".into()), "what is ignored stays so");
        }

        #[test]
        fn the_kernel_says_what_is_ignored() {
            assert_eq!(ignored("SigBlk:\t0000000000000000\nSigIgn:\t0000000000000001\nSigCgt:\t0\n"), 1);
            assert_eq!(ignored("nothing of it"), u64::MAX);
        }
    }
}
