/* A sky for rays that hit nothing: from the horizon's colour to the zenith's. Seen in mirrors and by hooks' cameras. */
#pragma relume parameter color horizon = 1 0.55 0.3
#pragma relume parameter color zenith = 0.15 0.25 0.6

struct relume_request miss(struct relume_miss missed, struct relume_parameters parameters)
{
	return relume_color(mix(parameters.horizon, parameters.zenith, sqrt(clamp(missed.direction.y, 0.0f, 1.0f))));
}
