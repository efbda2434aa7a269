/*
 * All packet kernels of a plain frame as one program. PoCL reads 900 KB of its own headers for each program, in every
 * run.
 */
#include "kernels/camera/camera_packet.cl"
#include "kernels/frame/compose_packet.cl"
#include "kernels/frame/layered.cl"
#include "kernels/frame/plain.cl"
#include "kernels/frame/plain_whole.cl"
#include "kernels/frame/resolve.cl"
#include "kernels/frame/resolve_packet.cl"
#include "kernels/frame/shade_packet.cl"
#include "kernels/frame/shadow.cl"
#include "kernels/frame/shadow_packet.cl"
#include "kernels/frame/vertex_packet.cl"
#include "kernels/frame/window.cl"
#include "kernels/rays/rays_packet.cl"
