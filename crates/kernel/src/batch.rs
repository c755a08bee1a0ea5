use crate::{Hit, Prepared, Which};
use lancer_math::Ray;

impl Prepared {
    /// The nearest hit of each ray with 0 < t < `t_max`, as [`nearest`](Self::nearest)
    /// finds it. Large batches are faster.
    ///
    /// # Panics
    /// Where there are not as many places for hits as rays.
    pub fn nearest_each(&self, rays: &[Ray], t_max: f64, hits: &mut [Option<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "rays and places for their hits");
        match self.only_shape() {
            Some(shape) => {
                let mut crossings = vec![None; rays.len()];
                shape.nearest_each(rays, t_max, &mut crossings);
                for (hit, crossing) in hits.iter_mut().zip(crossings) {
                    *hit = crossing.map(|crossing| Hit {
                        t: crossing.t,
                        item: 0,
                        part: crossing.part,
                    });
                }
            }
            None => {
                for (ray, hit) in rays.iter().zip(hits) {
                    *hit = self.nearest(ray, t_max);
                }
            }
        }
    }

    /// Whether each ray has a hit with 0 < t < `t_max`, as [`any`](Self::any) finds
    /// it. Large batches are faster.
    ///
    /// # Panics
    /// Where there are not as many places for answers as rays.
    pub fn any_each(&self, rays: &[Ray], t_max: f64, answers: &mut [bool]) {
        assert_eq!(rays.len(), answers.len(), "rays and places for their answers");
        match self.only_shape() {
            Some(shape) => shape.any_each(rays, t_max, answers),
            None => {
                for (ray, answer) in rays.iter().zip(answers) {
                    *answer = self.any(ray, t_max, Which::All);
                }
            }
        }
    }
}
