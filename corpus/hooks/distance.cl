/*
 * A shape given only by its distance function, on surfaces where rules set `shape: 1` (distance.look.yaml): the
 * frame of a box merged smoothly with a ball, fitted into the box of the drawn mesh. The ray advances by the distance
 * known to be empty (J. C. Hart, "Sphere tracing", The Visual Computer 12, 1996).
 */
#pragma relume parameter int shape = 0
#pragma relume parameter float thickness = 0.12
#pragma relume parameter float ball = 0.85
#pragma relume parameter float melt = 0.2

/* A cube minus three square bars through it: a lower bound of the distance. */
static float frame_at(float4 p, float half_size, float thickness)
{
	const float4 q = fabs(p) - half_size;
	const float cube = max(q.x, max(q.y, q.z)), bars = min(max(q.x, q.y), min(max(q.y, q.z), max(q.z, q.x)));

	return max(cube, -bars - thickness);
}

/* The shape's distance, in a cube from -1 to 1. */
static float distance_at(float4 p, struct relume_parameters parameters)
{
	const float frame = frame_at(p, 0.95f, 2.0f * parameters.thickness), ball = length(p) - parameters.ball;
	const float h = clamp(0.5f + 0.5f * (ball - frame) / parameters.melt, 0.0f, 1.0f);

	return mix(ball, frame, h) - parameters.melt * h * (1.0f - h);
}

struct relume_box bounds(struct relume_object object, struct relume_parameters parameters)
{
	return parameters.shape ? object.box : relume_no_box();
}

struct relume_request intersection(struct relume_crossing crossing, struct relume_parameters parameters)
{
	const float4 middle = 0.5f * (crossing.object.box.lower + crossing.object.box.upper);
	float4 radius = max(0.5f * (crossing.object.box.upper - crossing.object.box.lower), 1e-6f), o, d, p, normal;
	float t = crossing.enter, step, length_of_d;
	const float e = 1e-3f;

	radius.w = 1.0f;
	o = (crossing.ray.origin - middle) / radius;
	d = crossing.ray.direction / radius;
	length_of_d = length(d);
	for (int i = 0; i < 160; i++) {
		p = o + t * d;
		step = distance_at(p, parameters);
		/* Rays may start on the surface and leave it: only an approach counts as a hit. */
		if (step < 2e-4f) {
			normal = (float4)(distance_at(p + (float4)(e, 0.0f, 0.0f, 0.0f), parameters) -
			                          distance_at(p - (float4)(e, 0.0f, 0.0f, 0.0f), parameters),
			                  distance_at(p + (float4)(0.0f, e, 0.0f, 0.0f), parameters) -
			                          distance_at(p - (float4)(0.0f, e, 0.0f, 0.0f), parameters),
			                  distance_at(p + (float4)(0.0f, 0.0f, e, 0.0f), parameters) -
			                          distance_at(p - (float4)(0.0f, 0.0f, e, 0.0f), parameters),
			                  0.0f);
			if (dot(normal, d) < 0.0f)
				return relume_surface(t, normal / radius);
		}
		t += max(step, 2e-4f) / length_of_d;
		if (t > crossing.leave)
			break;
	}
	return relume_ignore();
}
