import { Color } from 'three';
import { roundLength } from '../stage.js';
import { fineSurface } from './fine_surface.js';
import { DistanceScale, insideColour } from './scale.js';
import { SignedDistance } from './signed_distance.js';
import { VertexDistances, texels } from './vertex_distances.js';

const budget = 4; // time to measure in, for each picture [ms]

function extent({ low, high }) {
  return Math.max(...high.map((v, axis) => v - low[axis]));
}

/** Makes a material take its colour from the distances of the vertices. */
function colourByDistance(material, texture, scale, tolerance) {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, {
      distances: { value: texture }, near: { value: scale.near }, far: { value: scale.far },
      tolerance: { value: tolerance }, colours: { value: scale.colours }, inside: { value: new Color(insideColour) },
    });
    shader.vertexShader = shader.vertexShader.replace('#include <common>', `#include <common>
      uniform highp sampler2D distances;
      attribute float vertex;
      varying float surfaceDistance;`).replace('#include <begin_vertex>', `#include <begin_vertex>
      int texel = int(vertex);
      surfaceDistance = texelFetch(distances, ivec2(texel % ${texels}, texel / ${texels}), 0).r;`);
    const last = scale.colours.length - 1;
    shader.fragmentShader = shader.fragmentShader.replace('#include <common>', `#include <common>
      uniform float near, far, tolerance;
      uniform vec3 colours[${last + 1}], inside;
      varying float surfaceDistance;`).replace('#include <color_fragment>', `
      float place = log(1.0 + max(surfaceDistance, 0.0) / near) / log(1.0 + far / near) * ${last}.0;
      int stop = min(int(place), ${last - 1});
      diffuseColor.rgb = surfaceDistance < -tolerance ? inside :
        mix(colours[stop], colours[stop + 1], min(place - float(stop), 1.0));`).replace('#include <emissivemap_fragment>', `
      totalEmissiveRadiance += 0.3 * diffuseColor.rgb;`); // so that shadows do not hide the colour
  };
}

/** Colours the god objects of a picture by their distance to the surface of the still body, on request. */
export class DistanceColours {
  constructor(picture) {
    this.picture = picture;
    this.on = false;
    this.scale = new DistanceScale(roundLength(0.1 * picture.size));
    this.isSigned = picture.data.still.closed;
  }

  /** Makes the surfaces that are coloured: one geometry, and the distances of each motion. */
  make() {
    const { picture: { data, still, motions }, scale } = this;
    const field = new SignedDistance(data.still, still.surface.geometry);
    const measure = (point, bound) => field.measure(point, bound);
    const { geometry, points } = fineSurface(data.moving, motions[0].surface.geometry, this.picture.size);
    const rounding = (extent(data.still) + extent(data.moving)) / 65535; // of the vertices of a page
    this.motions = motions.map((motion) => {
      const distances = new VertexDistances(points, scale, measure);
      motion.addColoured(geometry, (material) => colourByDistance(material, distances.texture, scale, rounding));
      return distances;
    });
  }

  setOn(on) {
    this.on = on;
    if (on && !this.motions) this.make();
    for (const motion of this.picture.motions) motion.showColoured(on);
    this.picture.invalidate();
  }

  /** Measures the distances further. Returns true if colours changed. */
  advance() {
    if (!this.on) return false;
    const { motions } = this.picture;
    const changes = this.motions.map((distances, i) => {
      motions[i].godObject.updateMatrix();
      return distances.advance(motions[i].godObject.matrix, budget / motions.length);
    });
    return changes.includes(true);
  }
}
