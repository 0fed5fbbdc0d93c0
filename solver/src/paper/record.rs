//! Keeps the last cycle: lines of every tooth and the pressure map of tooth 0.
//!
//! Lines are at the contact nodes of tooth 0, film and contact line loads being nodal force over spacing. Where another
//! tooth carries other nodes, its film thickness is interpolated there, and each nodal force is shared by the two
//! nodes beside it, so that sums are kept.

use super::march::March;
use super::mesh::Interpolation;
use crate::recording::{LineLoads, Recording, Touching};
use crate::rotor::Compliances;

/// Fills a [`Recording`] frame by frame; every cycle overwrites the last.
#[derive(Clone, Debug)]
pub(super) struct Recorder {
    pub(super) recording: Recording,
    /// Where each local node is among the entries of each tooth, `[tooth][node]`.
    places: Vec<Interpolation>,
    /// Per top, where its forces go among the local nodes.
    shares: Vec<Interpolation>,
    /// Per tooth, whether the last frame had contact on it.
    touched: Vec<bool>,
}

impl Recorder {
    /// Every frame initially holds the present state of the march; after a cancellation, frames that were not reached keep it.
    pub(super) fn new(march: &March<'_>, rotor: &Compliances) -> Self {
        let (motor, meshes) = (march.motor, &march.meshes);
        let (teeth, frames, nx, ny) = (motor.teeth, march.steps, march.film.nx(), march.film.ny());
        let (b, w) = (motor.tooth_width, motor.contact_width);
        let x: Vec<f64> = meshes.tooth(0).iter().filter(|entry| entry.on_tooth).map(|entry| entry.xi).collect();
        let nodes = x.len();
        let mut places = Vec::with_capacity(teeth * nodes);
        for tooth in 0..teeth {
            let entries = meshes.tooth(tooth);
            for &xi in &x {
                places.push(Interpolation::uniform((xi - entries[0].xi) / meshes.spacing, entries.len() - 1));
            }
        }
        let shares = meshes
            .tops
            .iter()
            .map(|top| Interpolation::uniform((meshes.entries[top.entry].xi - x[0]) / meshes.spacing, nodes - 1))
            .collect();
        let lines = teeth * frames * nodes;
        let recording = Recording {
            lines: LineLoads {
                frames,
                length: motor.wavelength(),
                teeth,
                stored_teeth: teeth,
                pitch: motor.pitch(),
                x,
                node_length: vec![meshes.spacing; nodes],
                contact: vec![0.0; lines],
                film: vec![0.0; lines],
                film_thickness: vec![0.0; lines],
                ..LineLoads::default()
            },
            touching: Touching { min_spacing: motor.min_spacing, compliance: rotor.beyond(meshes.n / 2) },
            rotor: rotor.clone(),
            period: motor.period(),
            stator: vec![0.0; lines],
            map_x: (0..nx).map(|i| b * (i as f64 / (nx - 1) as f64 - 0.5)).collect(),
            map_y: (0..ny).map(|j| w * (j as f64 / (ny - 1) as f64 - 0.5)).collect(),
            pressure: vec![0.0; frames * nx * ny],
            film_load: vec![0.0; frames],
            contact_load: vec![0.0; frames],
            teeth_in_contact: vec![0; frames],
            min_film_thickness: vec![0.0; frames],
            max_pressure: vec![0.0; frames],
            ..Recording::default()
        };
        let mut recorder = Self { recording, places, shares, touched: vec![false; teeth] };
        for frame in 0..frames {
            recorder.record(march, frame);
        }
        recorder
    }

    /// Stores the march's present instant as frame `frame`.
    pub(super) fn record(&mut self, march: &March<'_>, frame: usize) {
        let (motor, meshes, contact) = (march.motor, &march.meshes, &march.contact);
        let nodes = self.recording.x.len();
        let phase = frame as f64 / march.steps as f64;
        let recording = &mut self.recording;
        for tooth in 0..motor.teeth {
            let gap = &march.gap[meshes.first[tooth]..meshes.first[tooth + 1]];
            let at = recording.line_offset(tooth, frame);
            let middle = tooth as f64 * motor.pitch();
            for node in 0..nodes {
                let (xi, place) = (recording.x[node], self.places[tooth * nodes + node]);
                recording.film_thickness[at + node] = motor.min_spacing + place.of(gap);
                recording.stator[at + node] = motor.stator_displacement(middle + xi, xi, phase);
                recording.film[at + node] = 0.0;
                recording.contact[at + node] = 0.0;
            }
        }
        self.touched.fill(false);
        let forces = contact.force.iter().zip(&march.nodal);
        for ((top, share), (&contact, &film)) in meshes.tops.iter().zip(&self.shares).zip(forces) {
            let at = recording.line_offset(top.tooth, frame) + share.at;
            for (line, force) in [(&mut recording.lines.contact, contact), (&mut recording.lines.film, film)] {
                line[at] += (1.0 - share.weight) * force / meshes.spacing;
                if share.weight > 0.0 {
                    line[at + 1] += share.weight * force / meshes.spacing;
                }
            }
            self.touched[top.tooth] |= contact > 0.0;
        }
        let field = march.film.nodes();
        let h_m = motor.min_spacing;
        let p_a = motor.gas.ambient_pressure;
        for (out, p) in recording.pressure[frame * field..(frame + 1) * field].iter_mut().zip(&march.p) {
            *out = p * p_a;
        }
        recording.film_load[frame] = march.nodal.iter().sum();
        recording.contact_load[frame] = contact.force.iter().sum();
        recording.teeth_in_contact[frame] = self.touched.iter().filter(|&&touched| touched).count();
        recording.min_film_thickness[frame] = h_m * march.h.iter().copied().fold(f64::INFINITY, f64::min);
        recording.max_pressure[frame] = p_a * march.p.iter().copied().fold(0.0, f64::max);
    }
}
