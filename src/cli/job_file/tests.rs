use super::*;

fn file(text: &str, given: &[&'static str]) -> Result<JobFile, String> {
    let given = given.iter().map(|id| Id::from(*id)).collect();
    JobFile::parse("site/job.toml".into(), "site".into(), text.as_bytes(), given).map_err(|errors| errors.to_string())
}

fn words(text: &str, given: &[&'static str]) -> Vec<String> {
    file(text, given).unwrap().words().into_iter().map(|word| word.into_string().unwrap()).collect()
}

#[track_caller]
fn refused(text: &str, message: &str) {
    assert_eq!(file(text, &[]).unwrap_err(), message, "{text}");
}

#[test]
fn options_become_arguments() {
    let text = "input = 'line.geojson'\nslope = \"1:1.5\"\ncut_slope = '1:1'\nto-elevation = -5\ntolerance = 5e-3\nclosed = true\n\
                strict = false\noutput = ['a.obj', '/tmp/b.ply', '-']\nterrain = '../ground.obj'\nclass = [2, 8]\nfeature = 'x y'\n";
    assert_eq!(
        words(text, &[]),
        [
            "--slope=1:1.5",
            "--cut-slope=1:1",
            "--to-elevation=-5",
            "--tolerance=5e-3",
            "--closed",
            "--output=site/a.obj",
            "--output=/tmp/b.ply",
            "--output=-",
            "--terrain=site/../ground.obj",
            "--class=2",
            "--class=8",
            "--feature=x y",
        ]
    );
    assert_eq!(words("", &[]), [""; 0]);
    assert_eq!(words("\u{feff}slope = '1:2'\r\n", &[]), ["--slope=1:2"]);
}

#[test]
fn arguments_win() {
    let text = "slope = '1:1.5'\noutput = ['a.obj', 'b.obj']\nheight = 5\nquiet = true\nstations = 20\n";
    assert_eq!(words(text, &["slope", "output"]), ["--height=5", "--quiet", "--stations=20"]);
    // What excludes another option gives way to it: ends of the slopes, quiet and verbose.
    assert_eq!(
        words(text, &["distance", "verbose"]),
        ["--slope=1:1.5", "--output=site/a.obj", "--output=site/b.obj", "--stations=20"]
    );
}

/// Every option of `build` is a key; the types come from the parser.
#[test]
fn no_option_is_missing() {
    let command = declared();
    let mut count = 0;
    for arg in command.get_arguments().filter(|arg| !arg.is_global_set()) {
        let Some(long) = arg.get_long() else { continue };
        let value = match arg.get_action() {
            clap::ArgAction::SetTrue => "true".to_owned(),
            _ => match arg.get_possible_values().first() {
                Some(value) => format!("\"{}\"", value.get_name()),
                None => "\"2\"".to_owned(),
            },
        };
        let found = words(&format!("{long} = {value}\n"), &[]);
        assert!(found.len() == 1 && found[0].starts_with(&format!("--{long}")), "{long}: {found:?}");
        assert_eq!(found, words(&format!("{} = {value}\n", long.replace('-', "_")), &[]));
        assert!(words(&format!("{long} = {value}\n"), &[arg.get_id().as_str().to_owned().leak()]).is_empty(), "{long}");
        count += 1;
    }
    assert!(count > 30, "{count}");
}

#[test]
fn wrong_keys() {
    refused(
        "slope = '1:2'\n\n  cutslope = '1:1'\n",
        "`cutslope` is no option of `slopegen build`\n  --> site/job.toml, line 3, column 3\n   = the nearest is `cut-slope`\n   \
         = help: write `cut-slope`",
    );
    refused(
        "colour = 1\n",
        "`colour` is no option of `slopegen build`\n  --> site/job.toml, line 1, column 1\n   \
         = the keys are the long names of the options, without `--`\n   = help: see `slopegen build --help`",
    );
    refused(
        "cut_slope = '1:1'\ncut-slope = '1:2'\n",
        "`cut-slope` is set twice\n  --> site/job.toml, line 2, column 1\n   = `-` and `_` in keys are the same\n   \
         = help: keep one of them",
    );
    // Global options and help are none of a job.
    for key in ["color", "help", "version"] {
        assert!(file(&format!("{key} = 'auto'"), &[]).unwrap_err().contains("is no option"), "{key}");
    }
}

#[test]
fn wrong_types_all_at_once() {
    refused(
        "closed = 'yes'\nslope = ['1:2', '1:3']\nterrain = 5\nslope-x = 1\nheight = true\noutput = ['a.obj', 7]\nfeature = ['']\n\
         width = 2026-01-01\nside = {a = 1}\ncrossfall = 0x10\n",
        "`closed` is true or false\n  --> site/job.toml, line 1, column 10\n   = found the text \"yes\"\n   \
         = help: write `closed = true`\nerror: \
         `slope` has one value\n  --> site/job.toml, line 2, column 9\n   = found a list of 2\n   \
         = help: write `slope = …` without brackets\nerror: \
         `terrain` is the name of a file\n  --> site/job.toml, line 3, column 11\n   = found the number 5\n   \
         = help: write `terrain = \"name\"`\nerror: \
         `slope-x` is no option of `slopegen build`\n  --> site/job.toml, line 4, column 1\n   = the nearest is `slope`\n   \
         = help: write `slope`\nerror: \
         `height` is a text or a number\n  --> site/job.toml, line 5, column 10\n   = found true\n   \
         = help: write `height = \"…\"`; see `slopegen build --help`\nerror: \
         `output` is the name of a file\n  --> site/job.toml, line 6, column 20\n   = found the number 7\n   \
         = help: write `output = \"name\"`\nerror: \
         `feature` is a text or a number\n  --> site/job.toml, line 7, column 12\n   = found an empty text\n   \
         = help: write `feature = \"…\"`; see `slopegen build --help`\nerror: \
         `width` is a text or a number\n  --> site/job.toml, line 8, column 9\n   = found a date\n   \
         = help: write `width = \"…\"`; see `slopegen build --help`\nerror: \
         `side` is a text or a number\n  --> site/job.toml, line 9, column 8\n   \
         = found a table; all options stand at the top of the file\n   \
         = help: write `side = \"…\"`; see `slopegen build --help`\nerror: \
         `crossfall` is a text or a number\n  --> site/job.toml, line 10, column 13\n   = found the number 0x10\n   \
         = help: write `crossfall = \"…\"`; see `slopegen build --help`",
    );
}

#[test]
fn wrong_values() {
    refused(
        "side = 'lefft'\nclass = [2, 300]\n",
        "`lefft` is no value of `side`\n  --> site/job.toml, line 1, column 8\n   = possible: left, right, both, inside, outside\n   \
         = help: write `left`\nerror: \
         `300` is no value of `class`\n  --> site/job.toml, line 2, column 13\n   = 300 is not in 0..=255\n   \
         = help: see `--class` in `slopegen build --help`",
    );
}

#[test]
fn what_is_no_toml() {
    let error = file("slope = 1:2\n", &[]).unwrap_err();
    assert!(error.starts_with("the job file is not valid TOML\n  --> site/job.toml, line 1, column "), "{error}");
    let error = JobFile::parse("a.toml".into(), "".into(), b"slope = '1:2'\n# \xE4\n", Vec::new()).unwrap_err().to_string();
    assert_eq!(error, "the job file is no UTF-8 text\n  --> a.toml, line 2\n   = help: save the file as UTF-8");
    // Columns count characters.
    let error = file("x = 'äöü' y\n", &[]).unwrap_err();
    assert!(error.contains("line 1, column 11"), "{error}");
    for hostile in ["[".repeat(100_000), format!("a{} = 1", ".a".repeat(100_000)), format!("x = {}", "[".repeat(100_000))] {
        assert!(file(&hostile, &[]).is_err());
    }
}

#[test]
fn places_in_messages() {
    let file = file("slope = '1:0.5'\nterrain = 'g.obj'\nclass = [2, 8]\n", &["side"]).unwrap();
    for (message, located) in [
        ("x\n  --> --slope 1:0.5\n   = y", "x\n  --> site/job.toml, line 1, column 9: --slope 1:0.5\n   = y"),
        ("x\n  --> --class 8", "x\n  --> site/job.toml, line 3, column 13: --class 8"),
        ("x\n  --> --slope", "x\n  --> site/job.toml, line 1, column 9: --slope"),
        ("x\n  --> --side inside", "x\n  --> --side inside"),
        ("x\n  --> --width", "x\n  --> site/job.toml: --width"),
        ("x\n  --> site/g.obj\n   = y", "x\n  --> site/g.obj\n  --> site/job.toml, line 2, column 11\n   = y"),
        ("x\n  --> site/g.obj, line 3", "x\n  --> site/g.obj, line 3"),
    ] {
        assert_eq!(file.locate(message), located);
    }
}
