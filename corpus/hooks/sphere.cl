/*
 * Spheres on surfaces where rules set `sphere: 1` (sphere.look.yaml): each fills the box of the drawn mesh, in
 * that mesh's space, with its material. A box, or a few flat faces, thus becomes exactly round.
 */
#pragma relume parameter int sphere = 0

struct relume_box bounds(struct relume_object object, struct relume_parameters parameters)
{
	return parameters.sphere ? object.box : relume_no_box();
}

struct relume_request intersection(struct relume_crossing crossing, struct relume_parameters parameters)
{
	const float4 middle = 0.5f * (crossing.object.box.lower + crossing.object.box.upper);
	const float4 size = 0.5f * (crossing.object.box.upper - crossing.object.box.lower), radius = max(size, 1e-6f);
	float4 o = (crossing.ray.origin - middle) / radius, d = crossing.ray.direction / radius;
	float a, b, c, root, t;

	o.w = d.w = 0.0f;
	a = dot(d, d);
	b = dot(o, d);
	c = dot(o, o) - 1.0f;
	root = b * b - a * c;
	if (root < 0.0f)
		return relume_ignore();
	root = sqrt(root);
	t = (-b - root) / a;
	if (t < crossing.least)
		t = (-b + root) / a;
	if (t < crossing.least || t > crossing.most)
		return relume_ignore();
	return relume_surface(t, (o + t * d) / radius);
}
