//! Runs the passes of a plan.

use super::{Products, Renderer};
use crate::{
    gpu::{device::GpuError, environment::Environment, plate::upload_plate},
    plan::{GpuState, Pass, Plan, Product, Work},
};

impl Renderer {
    /// Runs a plan that was made for the present [`Self::state`].
    pub fn execute(&mut self, plan: &Plan) -> Result<(), GpuError> {
        self.execute_from(plan, 0, || true).map(drop)
    }

    /// Runs the passes of such a plan, of which some are done already, until all are or it shall not go on after one of them. Returns how many are
    /// done then; the state follows once all are. After a failure the state is what is sure to be on the device still.
    pub fn execute_from(
        &mut self,
        plan: &Plan,
        mut done: usize,
        goes_on: impl Fn() -> bool,
    ) -> Result<usize, GpuError> {
        if plan.is_empty() {
            return Ok(0);
        }
        match self.run_from(plan, &mut done, goes_on) {
            Ok(()) if done == plan.steps.len() => self.enter(plan.after.clone()),
            Ok(()) => {}
            Err(error) => {
                self.recover(plan, done);
                return Err(error);
            }
        }
        Ok(done)
    }

    /// Takes down what is on the device.
    fn enter(&mut self, state: GpuState) {
        self.prepared.clear();
        self.state = state;
        self.products.keep(&self.state);
        for (field, film) in self.state.fields.iter_mut().zip(&self.products.films) {
            if let (Some(field), Some(film)) = (field, film) {
                field.rest = film.rest();
            }
        }
    }

    /// After a pass has failed: where only the picture was left to make, all else is kept, otherwise nothing. What is gone is made again from the
    /// scene when it is needed.
    fn recover(&mut self, plan: &Plan, done: usize) {
        let lacks_picture = plan.steps[done..].iter().all(|(pass, _)| matches!(pass, Pass::Draw(_) | Pass::Tonemap(_)));
        if lacks_picture && !self.gpu.is_lost() {
            self.products.forget_pictures();
            self.enter(GpuState { radiance: None, picture: None, ..plan.after.clone() });
        } else {
            self.products = Products::default();
            self.enter(GpuState::default());
        }
    }

    /// Runs the passes in order, and counts what is done; equal steps that stand side by side are taken together.
    fn run_from(&mut self, plan: &Plan, done: &mut usize, goes_on: impl Fn() -> bool) -> Result<(), GpuError> {
        for passes in plan.steps[*done..].chunk_by(|(pass, _), (next, _)| pass.steps_like(next)) {
            match passes {
                [(pass, _)] => self.run(pass)?,
                together => self.step(together.iter().map(|(pass, _)| pass))?,
            }
            self.gpu.check()?;
            *done += passes.len();
            if !goes_on() {
                break;
            }
        }
        Ok(())
    }

    fn run(&mut self, pass: &Pass) -> Result<(), GpuError> {
        match pass {
            Pass::UploadEnvironment { light, key } => {
                self.light(*light).environment = Some(Environment::upload(&self.gpu, &key.0));
                Ok(())
            }
            Pass::DefocusBackdrop { light, key, adds } => {
                let Product::Backdrop(tiles) = self.prepared.take(&Work::Defocus(key.clone())) else { return Ok(()) };
                let present = self.light(*light).defocused.take().filter(|_| *adds);
                let defocused = present.unwrap_or_else(|| Environment::for_tiles(&self.gpu, &tiles));
                defocused.write_tiles(&self.gpu, &tiles);
                self.light(*light).defocused = Some(defocused);
                Ok(())
            }
            Pass::UploadPlate(key) => {
                self.products.plate = Some(upload_plate(&self.gpu, key));
                Ok(())
            }
            Pass::BakeTable { light, material, key, rows } => self.bake([*light, *material], key, rows.clone()),
            Pass::FitQuadrature { light, material, key } => {
                self.fit([*light, *material], key);
                Ok(())
            }
            Pass::SeedField { film, key } => self.seed(*film, key),
            Pass::RestoreField { film, slot, .. } => self.copy_state(*film, |film, recorder| {
                film.restore(recorder, *slot);
                Ok(())
            }),
            Pass::SaveField { film, slot, .. } => self.copy_state(*film, |film, recorder| film.save(recorder, *slot)),
            Pass::StepField { .. } => self.step([pass].into_iter()),
            Pass::ShowField { film, key } => self.show(*film, key),
            Pass::OpenHole { film, key } => self.open_hole(*film, key),
            Pass::Draw(key) => self.draw(key),
            Pass::Tonemap(key) => self.tonemap(key),
        }
    }
}
