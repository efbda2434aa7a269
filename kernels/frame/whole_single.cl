/* The kernels of a plain frame by one ray and one pixel a work item as one program: see whole_packet.cl. */
#include "kernels/camera/camera_wide.cl"
#include "kernels/frame/compose.cl"
#include "kernels/frame/plain_single.cl"
#include "kernels/frame/resolve.cl"
#include "kernels/frame/shade.cl"
#include "kernels/frame/shadow.cl"
#include "kernels/frame/vertex.cl"
#include "kernels/rays/rays_single.cl"
