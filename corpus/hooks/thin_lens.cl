/* A camera with a thin lens: objects at distance `focus` from the viewer are sharp, all others blurred. Use many
 * samples (--samples 64). */
#pragma relume parameter float focus = 10
#pragma relume parameter float radius = 0.1

struct relume_ray ray_generation(struct relume_pixel pixel, struct relume_parameters parameters)
{
	const float4 sharp = pixel.ray.origin +
	                     pixel.ray.direction * ((parameters.focus + pixel.ray.origin.z) / -pixel.ray.direction.z);
	const float angle = 6.2831853f * pixel.v, away = parameters.radius * sqrt(pixel.u);
	struct relume_ray ray;

	ray.origin = (float4)(away * cos(angle), away * sin(angle), 0.0f, 0.0f);
	ray.direction = sharp - ray.origin;
	return ray;
}
