/*
 * All packet kernels of a plain frame as one program. PoCL reads 900 KB of its own headers for each program, in every
 * run.
 */
#include "kernels/camera/camera_packet.cl"
#include "kernels/frame/packets/compose_packet.cl"
#include "kernels/frame/layered/layered.cl"
#include "kernels/frame/plain/plain.cl"
#include "kernels/frame/plain/plain_whole.cl"
#include "kernels/frame/stages/resolve.cl"
#include "kernels/frame/packets/resolve_packet.cl"
#include "kernels/frame/packets/shade_packet.cl"
#include "kernels/frame/light/shadow.cl"
#include "kernels/frame/packets/shadow_packet.cl"
#include "kernels/frame/packets/vertex_packet.cl"
#include "kernels/frame/stages/window.cl"
#include "kernels/rays/rays_packet.cl"
