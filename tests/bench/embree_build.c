#include "tests/bench/embree_build.h"

#include <math.h>
#include <pmmintrin.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xmmintrin.h>

#include "base/err.h"
#include "base/progress.h"

struct embree_build {
	const struct bench_mesh *mesh;
	RTCDevice device;
	RTCBVH bvh;                           /* reuses its memory in later builds */
	struct RTCBuildPrimitive *boxes;      /* the triangles' boxes */
	struct RTCBuildPrimitive *primitives; /* [capacity]: working copy, which the builder destroys */
	size_t capacity;
};

/* A node made by the callbacks. count 0: an inner node. */
struct peer_node {
	uint32_t count;
	uint32_t unused[3];
	struct peer_node *child[2];
	struct RTCBounds bounds[2];
};

static void *create_node(RTCThreadLocalAllocator allocator, unsigned n, void *user)
{
	struct peer_node *node = rtcThreadLocalAlloc(allocator, sizeof(*node), 16);

	(void)n, (void)user;
	node->count = 0;
	node->child[0] = node->child[1] = NULL;
	return node;
}

static void set_children(void *to, void **children, unsigned n, void *user)
{
	struct peer_node *node = to;

	(void)user;
	for (unsigned i = 0; i < n; i++)
		node->child[i] = children[i];
}

static void set_bounds(void *to, const struct RTCBounds **bounds, unsigned n, void *user)
{
	struct peer_node *node = to;

	(void)user;
	for (unsigned i = 0; i < n; i++)
		node->bounds[i] = *bounds[i];
}

static void *create_leaf(RTCThreadLocalAllocator allocator, const struct RTCBuildPrimitive *primitives, size_t n,
                         void *user)
{
	/* Memory for the triangles' numbers, as in any usable leaf. */
	uint32_t *leaf = rtcThreadLocalAlloc(allocator, (1 + n) * sizeof(*leaf), 16);

	(void)user;
	leaf[0] = (uint32_t)n;
	for (size_t i = 0; i < n; i++)
		leaf[1 + i] = primitives[i].primID;
	return leaf;
}

/* Cut triangle `primitive` at a plane: the boxes of both sides, within its present box. */
static void split_primitive(const struct RTCBuildPrimitive *primitive, unsigned axis, float position,
                            struct RTCBounds *left, struct RTCBounds *right, void *user)
{
	const struct embree_build *b = user;
	const uint32_t *index = b->mesh->index[primitive->primID];
	const float lo[3] = { primitive->lower_x, primitive->lower_y, primitive->lower_z };
	const float hi[3] = { primitive->upper_x, primitive->upper_y, primitive->upper_z };
	float box[2][2][3];

	for (int side = 0; side < 2; side++)
		for (int a = 0; a < 3; a++) {
			box[side][0][a] = INFINITY;
			box[side][1][a] = -INFINITY;
		}
	for (int i = 0; i < 3; i++) {
		const float *p = b->mesh->position[index[i]], *q = b->mesh->position[index[(i + 1) % 3]];

		for (int side = 0; side < 2; side++)
			for (int a = 0; a < 3 && (side ? p[axis] >= position : p[axis] <= position); a++) {
				box[side][0][a] = fminf(box[side][0][a], p[a]);
				box[side][1][a] = fmaxf(box[side][1][a], p[a]);
			}
		if ((p[axis] < position && q[axis] > position) || (p[axis] > position && q[axis] < position)) {
			const float s = (position - p[axis]) / (q[axis] - p[axis]);

			for (int side = 0; side < 2; side++)
				for (unsigned a = 0; a < 3; a++) {
					const float c = a == axis ? position : p[a] + s * (q[a] - p[a]);

					box[side][0][a] = fminf(box[side][0][a], c);
					box[side][1][a] = fmaxf(box[side][1][a], c);
				}
		}
	}
	for (int side = 0; side < 2; side++) {
		struct RTCBounds *out = side ? right : left;

		out->lower_x = fmaxf(box[side][0][0], lo[0]), out->upper_x = fminf(box[side][1][0], hi[0]);
		out->lower_y = fmaxf(box[side][0][1], lo[1]), out->upper_y = fminf(box[side][1][1], hi[1]);
		out->lower_z = fmaxf(box[side][0][2], lo[2]), out->upper_z = fminf(box[side][1][2], hi[2]);
	}
}

static void set_box(const struct bench_mesh *mesh, uint32_t i, struct RTCBuildPrimitive *out)
{
	const float *p = mesh->position[mesh->index[i][0]], *q = mesh->position[mesh->index[i][1]],
	            *r = mesh->position[mesh->index[i][2]];

	*out = (struct RTCBuildPrimitive){
		.lower_x = fminf(p[0], fminf(q[0], r[0])), .upper_x = fmaxf(p[0], fmaxf(q[0], r[0])),
		.lower_y = fminf(p[1], fminf(q[1], r[1])), .upper_y = fmaxf(p[1], fmaxf(q[1], r[1])),
		.lower_z = fminf(p[2], fminf(q[2], r[2])), .upper_z = fmaxf(p[2], fmaxf(q[2], r[2])),
		.geomID = 0, .primID = i,
	};
}

int embree_build_create(const struct bench_mesh *mesh, unsigned threads, struct embree_build **out)
{
	struct embree_build *b = calloc(1, sizeof(*b));
	char config[64];

	if (!b)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	snprintf(config, sizeof(config), "threads=%u", threads);
	_MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
	_MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
	b->mesh = mesh;
	b->device = rtcNewDevice(config);
	b->bvh = rtcNewBVH(b->device);
	/* Twice the triangles: Embree's own scenes allow the same for parts of split ones. */
	b->capacity = 2 * (size_t)mesh->n_triangles;
	b->boxes = aligned_alloc(64, (mesh->n_triangles * sizeof(*b->boxes) + 63) / 64 * 64);
	b->primitives = aligned_alloc(64, (b->capacity * sizeof(*b->primitives) + 63) / 64 * 64);
	if (!b->boxes || !b->primitives || rtcGetDeviceError(b->device)) {
		embree_build_destroy(&b);
		return err_report(ERR_SYSTEM, "Embree", "no device or no memory");
	}
	for (uint32_t i = 0; i < mesh->n_triangles; i++)
		set_box(mesh, i, &b->boxes[i]);
	*out = b;
	return 0;
}

void embree_build_destroy(struct embree_build **build)
{
	struct embree_build *b = *build;

	*build = NULL;
	if (!b)
		return;
	if (b->bvh)
		rtcReleaseBVH(b->bvh);
	if (b->device)
		rtcReleaseDevice(b->device);
	free(b->boxes);
	free(b->primitives);
	free(b);
}

static uint32_t count_nodes(const struct peer_node *node)
{
	return node->count ? 0 : 1 + count_nodes(node->child[0]) + count_nodes(node->child[1]);
}

/* Copy to our own format, parents before children. Returns the node's number. */
static uint32_t copy_tree(const struct peer_node *from, struct node2 *nodes, uint32_t *n)
{
	const uint32_t at = (*n)++;

	for (int side = 0; side < 2; side++) {
		const struct RTCBounds *box = &from->bounds[side];
		struct node2 *node = &nodes[at];

		node->lo[side][0] = box->lower_x, node->lo[side][1] = box->lower_y, node->lo[side][2] = box->lower_z;
		node->hi[side][0] = box->upper_x, node->hi[side][1] = box->upper_y, node->hi[side][2] = box->upper_z;
		node->count[side] = from->child[side]->count;
		node->child[side] = node->count[side] ? 0 : copy_tree(from->child[side], nodes, n);
	}
	return at;
}

int embree_build_tree(struct embree_build *b, enum RTCBuildQuality quality, uint32_t leaf_max, struct node2 **nodes,
                      uint32_t *n_nodes, double *seconds)
{
	struct RTCBuildArguments args = rtcDefaultBuildArguments();
	struct peer_node *root;

	args.buildQuality = quality;
	args.maxBranchingFactor = 2;
	args.maxDepth = BVH_MAX_DEPTH;
	args.maxLeafSize = leaf_max;
	args.bvh = b->bvh;
	args.primitives = b->primitives;
	args.primitiveCount = b->mesh->n_triangles;
	args.primitiveArrayCapacity = quality == RTC_BUILD_QUALITY_HIGH ? b->capacity : b->mesh->n_triangles;
	args.createNode = create_node;
	args.setNodeChildren = set_children;
	args.setNodeBounds = set_bounds;
	args.createLeaf = create_leaf;
	args.splitPrimitive = split_primitive;
	args.userPtr = b;
	memcpy(b->primitives, b->boxes, b->mesh->n_triangles * sizeof(*b->boxes));
	*seconds = progress_clock_s();
	root = rtcBuildBVH(&args);
	*seconds = progress_clock_s() - *seconds;
	if (!root)
		return err_report(ERR_SYSTEM, "Embree", "building a tree failed");
	if (!nodes)
		return 0;
	*nodes = malloc((count_nodes(root) + 1) * sizeof(**nodes));
	if (!*nodes)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	*n_nodes = 0;
	copy_tree(root, *nodes, n_nodes);
	return 0;
}

int embree_build_scene(struct embree_build *b, enum RTCBuildQuality quality, double *seconds)
{
	RTCScene scene = rtcNewScene(b->device);
	RTCGeometry geometry = rtcNewGeometry(b->device, RTC_GEOMETRY_TYPE_TRIANGLE);
	float *vertices;
	unsigned *indices;

	rtcSetSceneBuildQuality(scene, quality);
	rtcSetGeometryBuildQuality(geometry, quality);
	vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
	                                   b->mesh->n_vertices);
	indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
	                                  b->mesh->n_triangles);
	if (vertices && indices) {
		for (uint32_t i = 0; i < b->mesh->n_vertices; i++)
			memcpy(vertices + 3 * (size_t)i, b->mesh->position[i], 3 * sizeof(float));
		memcpy(indices, b->mesh->index, b->mesh->n_triangles * sizeof(*b->mesh->index));
		rtcCommitGeometry(geometry);
		rtcAttachGeometry(scene, geometry);
		*seconds = progress_clock_s();
		rtcCommitScene(scene);
		*seconds = progress_clock_s() - *seconds;
	}
	rtcReleaseGeometry(geometry);
	rtcReleaseScene(scene);
	return !vertices || !indices || rtcGetDeviceError(b->device) ?
	               err_report(ERR_SYSTEM, "Embree", "building a scene failed") :
	               0;
}
