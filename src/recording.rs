//! Fields of one cycle: plain data, what views and exports read.

/// Fields of one cycle of the periodic state, every array flat and in SI units.
///
/// Frame `m` is at t = m T/frames. Lines are stored `[tooth][frame][node]` for `stored_teeth` teeth: with lag
/// symmetry one tooth is stored, and tooth k at frame m is tooth 0 at frame m + k·frames/teeth (the wave travels
/// towards −x). The pressure map is tooth 0's, `[frame][ix][iy]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// Period \[s\].
    pub period: f64,
    /// One cycle of a transient: after its last frame comes another cycle, and no tooth is another one at another time.
    pub transient: bool,
    /// Frames in the cycle.
    pub frames: usize,
    /// Length along x of one period of the scene: the wavelength, or the plate's length \[m\].
    pub length: f64,
    /// Teeth in a wavelength (1 for a plate).
    pub teeth: usize,
    /// Teeth stored: 1 (lag symmetry) or `teeth`.
    pub stored_teeth: usize,
    /// Pitch of the teeth \[m\].
    pub pitch: f64,
    /// Node positions from the tooth's middle \[m\], ascending, `nodes`.
    pub x: Vec<f64>,
    /// Length of tooth that each node stands for \[m\], `nodes`: forces are line load × length.
    pub node_length: Vec<f64>,
    /// Film thickness h = gap + H_m \[m\].
    pub film_thickness: Vec<f64>,
    /// Stator's normal displacement W_S \[m\] (zero for a plate).
    pub stator: Vec<f64>,
    /// Contact line load \[N/m\].
    pub contact: Vec<f64>,
    /// Film's net gauge line load \[N/m\] (for a strip: gauge pressure × 1 m of width).
    pub film: Vec<f64>,
    /// x of the pressure map, from the tooth's middle \[m\].
    pub map_x: Vec<f64>,
    /// y of the pressure map, from the middle of the width \[m\]; only y ≥ 0 when `half_width`; `[0]` for a strip.
    pub map_y: Vec<f64>,
    /// The map covers y ≥ 0 only.
    pub half_width: bool,
    /// The map covers x ≥ 0 only (a plate).
    pub half_length: bool,
    /// Absolute pressure \[Pa\], `[frame][ix][iy]`.
    pub pressure: Vec<f64>,
    /// Of a transient: the same of the other teeth, `[tooth − 1][frame][ix][iy]`.
    pub other_pressure: Vec<f64>,
    /// Per frame: film load on one wavelength or the plate \[N\].
    pub film_load: Vec<f64>,
    /// Per frame: contact load \[N\].
    pub contact_load: Vec<f64>,
    /// Per frame: teeth that touch.
    pub teeth_in_contact: Vec<usize>,
    /// Per frame: least film thickness \[m\].
    pub min_film_thickness: Vec<f64>,
    /// Per frame: greatest pressure on any tooth \[Pa\].
    pub max_pressure: Vec<f64>,
    /// The line loads on the coarser grids of the same solve, coarse to fine: what is made of them has its error from these.
    /// Empty if there was one grid only, and of a plate.
    pub coarser: Vec<LineLoads>,
    /// Film load of a plate over the cycle \[N\] on the coarser grids, coarse to fine.
    pub coarser_film_load: Vec<Vec<f64>>,
}

/// Contact and film of a motor over one cycle on one grid, in the conventions of [`Recording`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineLoads {
    /// Frames in the cycle.
    pub frames: usize,
    /// Length along x of one period of the scene, the wavelength \[m\].
    pub length: f64,
    /// Teeth in a wavelength.
    pub teeth: usize,
    /// Teeth stored: 1 (lag symmetry) or `teeth`.
    pub stored_teeth: usize,
    /// Pitch of the teeth \[m\].
    pub pitch: f64,
    /// Node positions from the tooth's middle \[m\], `nodes`.
    pub x: Vec<f64>,
    /// Length of tooth that each node stands for \[m\], `nodes`.
    pub node_length: Vec<f64>,
    /// Contact line load \[N/m\], `[tooth][frame][node]` over the stored teeth.
    pub contact: Vec<f64>,
    /// Film's net gauge line load \[N/m\], likewise; zero without film.
    pub film: Vec<f64>,
}

impl Recording {
    /// Offset of tooth `tooth`, frame `frame` in the line arrays; `nodes` = `x.len()` values follow it.
    pub fn line_offset(&self, tooth: usize, frame: usize) -> usize {
        let (tooth, frame) = if self.stored_teeth == self.teeth {
            (tooth, frame)
        } else {
            (0, (frame + tooth * self.frames / self.teeth) % self.frames)
        };
        (tooth * self.frames + frame) * self.x.len()
    }

    /// Fills the series of each frame from the lines. `greatest`: greatest pressure \[Pa\] of each stored line.
    pub fn fill_series(&mut self, greatest: &[f64]) {
        let nodes = self.x.len();
        for frame in 0..self.frames {
            let (mut film, mut contact, mut touching) = (0.0, 0.0, 0);
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for tooth in 0..self.teeth {
                let line = self.line_offset(tooth, frame);
                for (i, length) in self.node_length.iter().enumerate() {
                    film += self.film[line + i] * length;
                    contact += self.contact[line + i] * length;
                    least = least.min(self.film_thickness[line + i]);
                }
                touching += usize::from(self.contact[line..line + nodes].iter().any(|c| *c > 0.0));
                most = most.max(greatest[line / nodes]);
            }
            self.film_load.push(film);
            self.contact_load.push(contact);
            self.teeth_in_contact.push(touching);
            self.min_film_thickness.push(least);
            self.max_pressure.push(most);
        }
    }

    /// Contact and film alone.
    pub fn line_loads(&self) -> LineLoads {
        LineLoads {
            frames: self.frames,
            length: self.length,
            teeth: self.teeth,
            stored_teeth: self.stored_teeth,
            pitch: self.pitch,
            x: self.x.clone(),
            node_length: self.node_length.clone(),
            contact: self.contact.clone(),
            film: self.film.clone(),
        }
    }

    /// Time of a frame \[s\].
    pub fn time(&self, frame: usize) -> f64 {
        self.period * frame as f64 / self.frames as f64
    }
}
