/*
 * Car paint: a coloured base that turns darker and bluer towards grazing angles, glittering flakes, and a clear coat
 * that mirrors more at grazing angles. Applies where rules set `paint: 1` (car_paint.look.yaml).
 */
#pragma relume parameter int paint = 0
#pragma relume parameter color base = 0.7 0.03 0.03
#pragma relume parameter color side = 0.15 0.0 0.12
#pragma relume parameter float flakes = 0.25
#pragma relume parameter float flake_size = 0.01

/* A number in [0,1) for each cell of space. */
static float flake_at(float4 place)
{
	const int4 cell = convert_int4_rtn(place);
	uint x = (uint)cell.x * 73856093u ^ (uint)cell.y * 19349663u ^ (uint)cell.z * 83492791u;

	x = (x ^ x >> 16) * 0x7feb352du;
	x = (x ^ x >> 15) * 0x846ca68bu;
	return (float)((x ^ x >> 16) >> 8) / 16777216.0f;
}

struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters parameters)
{
	const float cosine = clamp(-dot(hit.normal, hit.direction), 0.0f, 1.0f), turned = 1.0f - cosine;
	const float fresnel = 0.04f + 0.96f * turned * turned * turned * turned * turned;
	const float4 paint = mix(parameters.side, parameters.base, cosine);
	float4 color = paint * 0.2f;

	if (!parameters.paint)
		return relume_go_on();
	for (uint i = 0; i < relume_lights(&hit); i++) {
		const struct relume_light source = relume_light(&hit, i);
		const float4 half_way = normalize(source.direction - hit.direction);
		const float flake = flake_at(hit.position / parameters.flake_size);
		const float gloss = parameters.flakes * flake * flake * pow(max(dot(hit.normal, half_way), 0.0f), 12.0f);

		color += source.color * source.arrives * (paint * max(dot(hit.normal, source.direction), 0.0f) + gloss);
	}
	return relume_color_and_ray(color * (1.0f - fresnel), hit.direction + 2.0f * cosine * hit.normal, (float4)(fresnel));
}
