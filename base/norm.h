/* Integers that represent [-1,1]: GL's colours and normals (GL 2.1 table 2.9). */
#pragma once

/** A signed 32-bit integer. */
static inline float norm_int(double c)
{
	return (float)((2 * c + 1) / 4294967295.0);
}
