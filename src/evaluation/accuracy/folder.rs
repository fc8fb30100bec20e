//! The files of a run.

use super::pictures;
use super::stability::Study;
use super::survey::Survey;
use super::timing::Machine;
use crate::chart::page;

/// Names and texts of every file, `index.html` last, so that it is there only once all that it shows is.
#[must_use]
pub fn files(survey: &Survey, studies: &[Study], machine: &Machine) -> Vec<(String, String)> {
    let (main, matrix) = (
        pictures::share_time(survey, machine),
        pictures::matrix(survey),
    );
    let answers = pictures::answers(survey);
    let mut files = vec![
        ("survey.csv".to_owned(), survey.csv()),
        ("methods.csv".to_owned(), survey.methods_csv()),
        ("share-time.svg".to_owned(), main.svg()),
        ("share-time.csv".to_owned(), main.csv()),
        ("answers.svg".to_owned(), answers.svg()),
        ("matrix.svg".to_owned(), matrix.svg()),
    ];
    let part = |title: &str, svg: String| (title.to_owned(), String::new(), svg);
    let mut parts = vec![
        part(&main.title, main.svg()),
        part(&answers.title, answers.svg()),
        part(&matrix.title, matrix.svg()),
    ];
    for study in studies {
        files.push((format!("{}.csv", study.name), study.csv.clone()));
        // The sentence stands over the first picture of its study.
        let mut sentence = study.sentence.clone();
        for picture in &study.pictures {
            files.push((format!("{}.svg", picture.name), picture.svg.clone()));
            parts.push((
                picture.title.clone(),
                std::mem::take(&mut sentence),
                picture.svg.clone(),
            ));
        }
    }
    files.push((
        "index.html".to_owned(),
        page("Mobility methods: accuracy, speed, stability", &parts),
    ));
    files
}
