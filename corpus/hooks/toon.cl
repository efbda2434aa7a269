/* Toon shading: light in a few even steps, and dark outlines where a surface turns away. */
#pragma relume parameter int bands = 3
#pragma relume parameter float outline = 0.15
#pragma relume parameter float ambient = 0.25

struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters parameters)
{
	const float4 albedo = relume_albedo(&hit);
	float4 light = (float4)(parameters.ambient);

	if (relume_lights(&hit) == 0)
		return relume_go_on(); /* surfaces that OpenGL does not light are unchanged */
	if (-dot(hit.normal, hit.direction) < parameters.outline)
		return relume_color(albedo * 0.1f);
	for (uint i = 0; i < relume_lights(&hit); i++) {
		const struct relume_light source = relume_light(&hit, i);
		const float cosine = max(dot(hit.normal, source.direction), 0.0f);

		light += source.color * source.arrives * (ceil(cosine * parameters.bands) / parameters.bands);
	}
	return relume_color(min(albedo * light, (float4)(1.0f)));
}
