/* Sixteen GL numbers as light and back, as in encode.h. OpenCL C only. */
#pragma once

#include "kernels/encode.h"
#include "kernels/frame/pack/pack_vector.h"
#include "kernels/rays/gather.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/encode_lanes.h"
#include "kernels/one_lanes.h"

/* Three at once, so that their long dependency chains overlap. */
WIDE_VECTORS static inline void pack_linear3(packf *c)
{
	const packf first = encode_linear(c[0]), second = encode_linear(c[1]), third = encode_linear(c[2]);

	c[0] = first;
	c[1] = second;
	c[2] = third;
}
