/*
 * A gobo: window bars in front of each light, and tinted panes. The bars of a lamp are spaced by 1 / `panes` of the
 * distance to it, across a spot's axis or a vertical one; those of light at infinity by `size` / `panes`.
 */
#pragma relume parameter float panes = 2
#pragma relume parameter float bar = 0.12
#pragma relume parameter float size = 4
#pragma relume parameter color tint = 1 0.9 0.7

struct relume_request light(struct relume_beam beam, struct relume_parameters parameters)
{
	const float4 axis = dot(beam.axis, beam.axis) > 0.0f ? beam.axis :
	                    isinf(beam.distance)             ? -beam.direction :
	                                                       (float4)(0.0f, -1.0f, 0.0f, 0.0f);
	const float4 across = normalize(
		cross(axis, fabs(axis.y) < 0.9f ? (float4)(0.0f, 1.0f, 0.0f, 0.0f) : (float4)(0.0f, 0.0f, 1.0f, 0.0f)));
	const float4 up = cross(across, axis), from = isinf(beam.distance) ?
	                                                      beam.position :
	                                                      -beam.direction / max(dot(-beam.direction, axis), 1e-3f);
	const float scale = parameters.panes * (isinf(beam.distance) ? 1.0f / parameters.size : 1.0f);
	const float x = dot(from, across) * scale, y = dot(from, up) * scale;
	const float edge = min(fabs(x - rint(x)), fabs(y - rint(y)));

	return relume_color(edge < 0.5f * parameters.bar ? (float4)(0.0f) : parameters.tint);
}
