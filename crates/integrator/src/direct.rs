use crate::classic::engine::OriginalTracer;
use crate::{Engine, Plan, Tracer};
use lancer_scene::Scene;

/// The original program's non-recursive engine: the lit colour of the nearest
/// surface, and black where there is none. No mirrors, no glow.
#[derive(Debug, Clone, Copy, Default)]
pub struct Direct;

impl Engine for Direct {
    fn name(&self) -> &str {
        "direct"
    }

    fn summary(&self) -> &str {
        "the original's simple engine: lit surfaces and shadows, no mirrors, no glow"
    }

    fn warnings(&self, scene: &Scene) -> Vec<crate::Lint> {
        crate::classic::warnings(scene)
    }

    fn refusals(&self, scene: &Scene) -> Vec<String> {
        crate::classic::refusals(scene)
    }

    fn prepare<'s>(&'s self, scene: &'s Scene, plan: &Plan) -> Box<dyn Tracer + 's> {
        Box::new(OriginalTracer::new(scene, &plan.kernel, false))
    }
}
