/* Queries for programs other than a renderer: see kernels/rays/query.h. Compiled only when used. */
#include "kernels/rays/query.h"

__kernel void query_all(KERNEL_ARGUMENTS(query_all)) KERNEL_ITEMS(query_all, n)
__kernel void query_distance(KERNEL_ARGUMENTS(query_distance)) KERNEL_ITEMS(query_distance, n)
__kernel void query_box(KERNEL_ARGUMENTS(query_box)) KERNEL_ITEMS(query_box, n)
__kernel void query_sphere(KERNEL_ARGUMENTS(query_sphere)) KERNEL_ITEMS(query_sphere, n)
