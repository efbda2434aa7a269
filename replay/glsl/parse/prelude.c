#include "replay/glsl/parse/prelude.h"

#define BOTH 3u
#define VERTEX (1u << GLSL_VERTEX_STAGE)
#define FRAGMENT (1u << GLSL_FRAGMENT_STAGE)

/* Array lengths are Mesa's (22.3.6). Other limits are generous: the program did link when it was recorded. */
static const struct {
	uint32_t stages, version, extensions;
	bool is_old; /* not in the core profile */
	const char *text;
} parts[] = {
	{ BOTH, 0, 0, false,
	  "struct gl_DepthRangeParameters { float near, far, diff; }; uniform gl_DepthRangeParameters\n"
	  "gl_DepthRange; const int gl_MaxVertexAttribs = 16, gl_MaxVertexUniformComponents = 16384,\n"
	  "gl_MaxVaryingFloats = 128, gl_MaxVertexTextureImageUnits = 32, gl_MaxCombinedTextureImageUnits =\n"
	  "160, gl_MaxTextureImageUnits = 32, gl_MaxFragmentUniformComponents = 16384, gl_MaxDrawBuffers = 8;\n"
	  "const int gl_MaxLights = 8, gl_MaxClipPlanes = 8, gl_MaxTextureUnits = 8, gl_MaxTextureCoords = 8;" },
	{ BOTH, 130, 0, false,
	  "const int gl_MaxClipDistances = 8, gl_MaxVaryingComponents = 128, gl_MinProgramTexelOffset = -32,\n"
	  "gl_MaxProgramTexelOffset = 31;" },
	{ BOTH, 150, 0, false,
	  "const int gl_MaxVertexOutputComponents = 128, gl_MaxFragmentInputComponents = 128,\n"
	  "gl_MaxGeometryInputComponents = 128, gl_MaxGeometryOutputComponents = 128;" },
	{ BOTH, 0, 0, true,
	  "uniform mat4 gl_ModelViewMatrix, gl_ProjectionMatrix, gl_ModelViewProjectionMatrix,\n"
	  "gl_ModelViewMatrixInverse, gl_ProjectionMatrixInverse, gl_ModelViewProjectionMatrixInverse,\n"
	  "gl_ModelViewMatrixTranspose, gl_ProjectionMatrixTranspose, gl_ModelViewProjectionMatrixTranspose,\n"
	  "gl_ModelViewMatrixInverseTranspose, gl_ProjectionMatrixInverseTranspose,\n"
	  "gl_ModelViewProjectionMatrixInverseTranspose; uniform mat4 gl_TextureMatrix[8],\n"
	  "gl_TextureMatrixInverse[8], gl_TextureMatrixTranspose[8], gl_TextureMatrixInverseTranspose[8];\n"
	  "uniform mat3 gl_NormalMatrix; uniform float gl_NormalScale; uniform vec4 gl_ClipPlane[8],\n"
	  "gl_TextureEnvColor[8], gl_EyePlaneS[8], gl_EyePlaneT[8], gl_EyePlaneR[8], gl_EyePlaneQ[8],\n"
	  "gl_ObjectPlaneS[8], gl_ObjectPlaneT[8], gl_ObjectPlaneR[8], gl_ObjectPlaneQ[8]; struct\n"
	  "gl_PointParameters { float size, sizeMin, sizeMax, fadeThresholdSize, distanceConstantAttenuation,\n"
	  "distanceLinearAttenuation, distanceQuadraticAttenuation; }; uniform gl_PointParameters gl_Point;\n"
	  "struct gl_MaterialParameters { vec4 emission, ambient, diffuse, specular; float shininess; };\n"
	  "uniform gl_MaterialParameters gl_FrontMaterial, gl_BackMaterial; struct gl_LightSourceParameters {\n"
	  "vec4 ambient, diffuse, specular, position, halfVector; vec3 spotDirection; float spotExponent,\n"
	  "spotCutoff, spotCosCutoff, constantAttenuation, linearAttenuation, quadraticAttenuation; };\n"
	  "uniform gl_LightSourceParameters gl_LightSource[8]; struct gl_LightModelParameters { vec4 ambient;\n"
	  "}; uniform gl_LightModelParameters gl_LightModel; struct gl_LightModelProducts { vec4 sceneColor;\n"
	  "}; uniform gl_LightModelProducts gl_FrontLightModelProduct, gl_BackLightModelProduct; struct\n"
	  "gl_LightProducts { vec4 ambient, diffuse, specular; }; uniform gl_LightProducts\n"
	  "gl_FrontLightProduct[8], gl_BackLightProduct[8]; struct gl_FogParameters { vec4 color; float\n"
	  "density, start, end, scale; }; uniform gl_FogParameters gl_Fog;" },
	{ VERTEX, 0, 0, false, "out vec4 gl_Position; out float gl_PointSize;" },
	{ VERTEX, 0, 0, true,
	  "in vec4 gl_Color, gl_SecondaryColor, gl_Vertex, gl_MultiTexCoord0, gl_MultiTexCoord1,\n"
	  "gl_MultiTexCoord2, gl_MultiTexCoord3, gl_MultiTexCoord4, gl_MultiTexCoord5, gl_MultiTexCoord6,\n"
	  "gl_MultiTexCoord7; in vec3 gl_Normal; in float gl_FogCoord; out vec4 gl_ClipVertex, gl_FrontColor,\n"
	  "gl_BackColor, gl_FrontSecondaryColor, gl_BackSecondaryColor, gl_TexCoord[]; out float\n"
	  "gl_FogFragCoord;" },
	{ VERTEX, 130, 0, false, "out float gl_ClipDistance[];" },
	{ VERTEX, 130, PARSE_GPU_SHADER4, false, "in int gl_VertexID;" },
	{ VERTEX, 140, PARSE_GPU_SHADER4, false, "in int gl_InstanceID;" },
	{ VERTEX, 0, 0, false, "in int gl_InstanceIDARB;" },
	{ FRAGMENT, 0, 0, false,
	  "in vec4 gl_FragCoord; in bool gl_FrontFacing; out vec4 gl_FragColor, gl_FragData[8]; out float\n"
	  "gl_FragDepth;" },
	{ FRAGMENT, 0, 0, true,
	  "in vec4 gl_Color, gl_SecondaryColor, gl_TexCoord[]; in float gl_FogFragCoord;" },
	{ FRAGMENT, 120, 0, false, "in vec2 gl_PointCoord;" },
	{ FRAGMENT, 130, 0, false, "in float gl_ClipDistance[];" },
	{ FRAGMENT, 150, PARSE_GPU_SHADER4, false, "flat in int gl_PrimitiveID;" },
};

const unsigned parse_prelude_parts = sizeof(parts) / sizeof(parts[0]);

const char *parse_prelude(const struct parse *p, unsigned part)
{
	const bool has_version = p->version >= parts[part].version || p->extensions & parts[part].extensions;

	return parts[part].stages >> p->stage & 1 && has_version && !(parts[part].is_old && p->is_core) ?
	               parts[part].text :
	               NULL;
}
