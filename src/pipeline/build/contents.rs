//! What the outputs of a build hold, and how each is written.

use super::BuildJob;
use crate::model::Tin;
use crate::pipeline::desk;
use crate::pipeline::heads::{Names, is_local};
use crate::pipeline::rasters::Raster;
use crate::plot::{self, Drawing, Scene};
use crate::report::{Report, ReportFormat, write_station_table};
use crate::setout::Stake;
use crate::write::{
    Delivery, Earthworks, EncodeError, Head, LineFormat, MeshFormat, Outputs, RasterFormat, Reference, Target, WriteError,
    origin, write_origin, write_stakes,
};
use glam::DVec3;
use std::io::Write;

/// What one output holds.
#[derive(Clone, Copy)]
pub(super) enum Content {
    Mesh(MeshFormat),
    Finished(MeshFormat),
    Raster(RasterFormat),
    FinishedRaster(RasterFormat),
    Lines(LineFormat),
    Stakes,
    Plot(Drawing),
    Stations,
    /// Origin of the mesh of the output with this number.
    Origin(usize),
    Report(ReportFormat),
}

/// All outputs of a job.
pub(in crate::pipeline) fn targets(job: &BuildJob) -> Vec<Target> {
    contents(job).into_iter().map(|(target, _)| target).collect()
}

/// All outputs of a job, and what each holds.
pub(super) fn contents(job: &BuildJob) -> Vec<(Target, Content)> {
    let meshes = job.meshes.iter().map(|(target, format)| (target.clone(), Content::Mesh(*format)));
    let finished = job.finished.iter().map(|(target, format)| (target.clone(), Content::Finished(*format)));
    let rasters = job.rasters.design.iter().map(|(target, format)| (target.clone(), Content::Raster(*format)));
    let finished_rasters = job.rasters.finished.iter();
    let finished_rasters = finished_rasters.map(|(target, format)| (target.clone(), Content::FinishedRaster(*format)));
    let lines = job.lines.iter().map(|(target, format)| (target.clone(), Content::Lines(*format)));
    let reports = job.reports.iter().map(|(target, format)| (target.clone(), Content::Report(*format)));
    let tables = job.station_tables.iter().map(|target| (target.clone(), Content::Stations));
    let stakes = job.stakes.iter().map(|target| (target.clone(), Content::Stakes));
    let plots = job.plots.iter().map(|(target, drawing)| (target.clone(), Content::Plot(*drawing)));
    let mut all: Vec<(Target, Content)> = meshes.chain(finished).collect();
    // Beside every file that does not hold world coordinates stands one that tells its origin.
    for mesh in 0..all.len() {
        if let (Target::File(path), Content::Mesh(format) | Content::Finished(format)) = &all[mesh]
            && is_local(job, *format)
            && !all[mesh].0.is_stream()
        {
            all.push((Target::File(origin::sidecar(path)), Content::Origin(mesh)));
        }
    }
    all.extend(rasters.chain(finished_rasters).chain(lines).chain(stakes).chain(tables).chain(plots).chain(reports));
    all
}

/// All that outputs are made of, but for the report.
pub(super) struct Made<'a> {
    pub(super) job: &'a BuildJob,
    pub(super) targets: &'a [Target],
    pub(super) contents: &'a [Content],
    /// Line, design and line work, for drawings; other outputs take theirs from here.
    pub(super) scene: Scene<'a>,
    pub(super) names: &'a Names,
    pub(super) earthworks: Option<Earthworks<'a>>,
    /// Origin of files that do not hold world coordinates.
    pub(super) local: DVec3,
    /// Height of each vertex of the design over the ground, where a file shows it.
    pub(super) depths: Option<Vec<f64>>,
    pub(super) raster: Option<Raster>,
    pub(super) finished: Option<&'a Tin>,
    /// The same of the finished ground.
    pub(super) finished_depths: Option<Vec<f64>>,
    pub(super) finished_raster: Option<Raster>,
    pub(super) reference: Reference<'a>,
    pub(super) stakes: &'a [Stake],
}

impl Made<'_> {
    /// Whether an output is a report in JSON.
    pub(super) fn is_json(&self, index: usize) -> bool {
        matches!(self.contents[index], Content::Report(ReportFormat::Json))
    }

    /// The order in which outputs are written ([`desk::in_order`]), up to the first report in JSON and from there.
    pub(super) fn in_order(&self) -> (Vec<usize>, Vec<usize>) {
        let is_report = |i: usize| matches!(self.contents[i], Content::Report(_));
        let mut order = desk::in_order(self.targets, is_report, |i| self.is_json(i));
        let first = order.iter().position(|&i| self.is_json(i)).unwrap_or(order.len());
        let after = order.split_off(first);
        (order, after)
    }

    /// Writes the output of this number.
    pub(super) fn put(&self, outputs: &mut Outputs, index: usize, report: &Report) -> Result<Delivery, WriteError> {
        outputs.write(index, |out| self.write(out, index, report))
    }

    fn write(&self, out: &mut dyn Write, index: usize, report: &Report) -> Result<(), EncodeError> {
        let Self { job, scene, names, .. } = self;
        let head = Head {
            crs: scene.crs,
            unit: scene.unit,
            name: &names.design,
            lines: scene.lines,
            earthworks: self.earthworks,
            origin: None,
            depths: None,
        };
        let origin = |format: MeshFormat| Some(self.local).filter(|_| is_local(job, format));
        let grid = |format: RasterFormat, raster: &Option<Raster>, out: &mut dyn Write| match raster {
            Some((layout, values)) => format.write(out, layout, values, &self.reference),
            None => Ok(()),
        };
        match self.contents[index] {
            Content::Mesh(format) => {
                format.write(out, scene.design, &Head { depths: self.depths.as_deref(), origin: origin(format), ..head })
            }
            Content::Finished(format) => {
                let depths = self.finished_depths.as_deref();
                let head = Head { name: &names.finished, depths, origin: origin(format), ..head };
                self.finished.map_or(Ok(()), |tin| format.write(out, tin, &head))
            }
            Content::Lines(format) => format.write(out, &head),
            Content::Origin(mesh) => match &self.targets[mesh] {
                Target::File(path) => write_origin(out, path, &Head { origin: Some(self.local), ..head }),
                Target::Stdout => Ok(()),
            },
            Content::Raster(format) => grid(format, &self.raster, out),
            Content::FinishedRaster(format) => grid(format, &self.finished_raster, out),
            Content::Stakes => write_stakes(out, self.stakes),
            Content::Stations => write_station_table(out, report),
            Content::Plot(drawing) => Ok(out.write_all(plot::file(scene, drawing, &job.sections).as_bytes())?),
            Content::Report(format) => {
                let own = desk::run_at(&report.run, &self.targets[index], self.is_json(index));
                let own = own.map(|run| Report { run: Some(run), ..report.clone() });
                format.write(out, own.as_ref().unwrap_or(report), scene, &job.sections)
            }
        }
    }
}
