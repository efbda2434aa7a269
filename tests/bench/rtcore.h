/*
 * Embree 3 or 4, whichever is installed, under the same names. A query holds a call's parameters besides scene and
 * rays: the context of Embree 3, the arguments of Embree 4 (its README, "Upgrading from Embree 3 to Embree 4").
 */
#pragma once

#include <stddef.h>

#if __has_include(<embree4/rtcore.h>)

#include <embree4/rtcore.h>

struct peer_query {
	struct RTCRayQueryContext context;
	struct RTCIntersectArguments intersect;
	struct RTCOccludedArguments occluded;
};

static inline void peer_query_init(struct peer_query *query, int is_coherent)
{
	const enum RTCRayQueryFlags flags = is_coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;

	rtcInitRayQueryContext(&query->context);
	rtcInitIntersectArguments(&query->intersect);
	rtcInitOccludedArguments(&query->occluded);
	query->intersect.context = query->occluded.context = &query->context;
	query->intersect.flags = query->occluded.flags = flags;
}

static inline void peer_intersect(RTCScene scene, struct peer_query *query, struct RTCRayHit *r)
{
	rtcIntersect1(scene, r, &query->intersect);
}

static inline void peer_occluded(RTCScene scene, struct peer_query *query, struct RTCRay *r)
{
	rtcOccluded1(scene, r, &query->occluded);
}

/* Packets of N rays; valid: int[N]. */
#define PEER_INTERSECT(N, valid, scene, query, r) rtcIntersect##N(valid, scene, r, &(query)->intersect)
#define PEER_OCCLUDED(N, valid, scene, query, r) rtcOccluded##N(valid, scene, r, &(query)->occluded)

/* Streams of n rays, `stride` bytes apart. Embree 4 has none: ray by ray. */
static inline void peer_intersect_stream(RTCScene scene, struct peer_query *query, struct RTCRayHit *r, unsigned n,
                                         size_t stride)
{
	for (unsigned i = 0; i < n; i++)
		peer_intersect(scene, query, (struct RTCRayHit *)(void *)((char *)r + i * stride));
}

static inline void peer_occluded_stream(RTCScene scene, struct peer_query *query, struct RTCRay *r, unsigned n,
                                        size_t stride)
{
	for (unsigned i = 0; i < n; i++)
		peer_occluded(scene, query, (struct RTCRay *)(void *)((char *)r + i * stride));
}

#else

#include <embree3/rtcore.h>

struct peer_query {
	struct RTCIntersectContext context;
};

static inline void peer_query_init(struct peer_query *query, int is_coherent)
{
	rtcInitIntersectContext(&query->context);
	query->context.flags = is_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

static inline void peer_intersect(RTCScene scene, struct peer_query *query, struct RTCRayHit *r)
{
	rtcIntersect1(scene, &query->context, r);
}

static inline void peer_occluded(RTCScene scene, struct peer_query *query, struct RTCRay *r)
{
	rtcOccluded1(scene, &query->context, r);
}

#define PEER_INTERSECT(N, valid, scene, query, r) rtcIntersect##N(valid, scene, &(query)->context, r)
#define PEER_OCCLUDED(N, valid, scene, query, r) rtcOccluded##N(valid, scene, &(query)->context, r)

static inline void peer_intersect_stream(RTCScene scene, struct peer_query *query, struct RTCRayHit *r, unsigned n,
                                         size_t stride)
{
	rtcIntersect1M(scene, &query->context, r, n, stride);
}

static inline void peer_occluded_stream(RTCScene scene, struct peer_query *query, struct RTCRay *r, unsigned n,
                                        size_t stride)
{
	rtcOccluded1M(scene, &query->context, r, n, stride);
}

#endif
