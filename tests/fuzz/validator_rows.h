/* Where gnomon shows silently what the validator calls an error, or refuses what it does not, and
 * why that is right. */
#ifndef GN_TESTS_FUZZ_VALIDATOR_ROWS_H
#define GN_TESTS_FUZZ_VALIDATOR_ROWS_H

/* Errors that never change what is seen. */
static const struct {
    const char *code, *why;
} gn_validator_codes[] = {
    {"EMPTY_ENTITY", "an empty list or object is as good as none"},
    {"ACCESSOR_ANIMATION_INPUT_NEGATIVE",
     "times before 0 are played, as their exporters mean them"},
    {"ACCESSOR_ANIMATION_INPUT_NON_INCREASING",
     "keys at one time are a jump; times that fall are refused by a warning"},
    {"ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION", "made unit before use"},
    {"ROTATION_NON_UNIT", "made unit; all 0 is named by a warning"},
    {"GLB_CHUNK_LENGTH_UNALIGNED", "the chunk is read whole: padding matters to readers of words"},
    {"NODE_MATRIX_NON_TRS", "a matrix with shear is drawn as it stands"},
    {"UNSATISFIED_DEPENDENCY", "a skin, weights or a light's node without what they would act on"},
    {"ACCESSOR_INVALID_IBM", "the fourth row of an inverse bind matrix is taken as 0 0 0 1"},
    {"BUFFER_VIEW_TARGET_OVERRIDE", "a view's target is a hint to GPUs, which is not read"},
    {"MESH_PRIMITIVE_INVALID_ATTRIBUTE", "attributes of other names are not read"},
    {"MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR", "a target moves what there is"},
    {"MESH_PRIMITIVE_ACCESSOR_UNALIGNED", "values are read byte by byte"},
    {"MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", "bounds are measured"},
    {"MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE", "without a stride elements are packed"},
    {"MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", "joints without weights have weight 0"},
    {"MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE", "read by that stride"},
    {"DUPLICATE_ELEMENTS", "a name twice says no more than once"},
    {"INVALID_URI",
     "of image/gif, but with the bytes of a PNG: pictures are told apart by their bytes"},
    {"IMAGE_MIME_TYPE_INVALID", "pictures are told apart by their bytes"},
    {"IMAGE_NON_ENABLED_MIME_TYPE", "WebP is read without its extension, too"},
    {"TEXTURE_INVALID_IMAGE_MIME_TYPE", "WebP is read without its extension, too"},
    {"ACCESSOR_NON_CLAMPED", "colours are clamped"},
    {"ACCESSOR_INDEX_PRIMITIVE_RESTART", "255 is a vertex: restart is not on"},
    {"NODE_SKIN_NO_SCENE", "joints count where they are, in the scene or not"},
    {"SKIN_NO_COMMON_ROOT", "each joint has its own place"},
    {"SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE", "read by that stride"},
    {"SKIN_SKELETON_INVALID", "the skeleton's root is a hint, which is not read"},
    {"ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS",
     "weights of a mesh without targets move nothing"},
    {"ANIMATION_DUPLICATE_TARGETS", "one of the two is played: both are right"},
    {"ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE", "read by that stride"},
    {"ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS", "one key is a pose that stands"},
    {"ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", "whole numbers are seconds, too"},
    {"ANIMATION_CHANNEL_TARGET_NODE_MATRIX", "the matrix is taken apart into what can move"},
    {"ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", "bounds are measured"},
    {"ONE_OF_MISMATCH", "the camera's type says which of the two is meant"},
    {"KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT",
     "one of the two mappings is shown: both are right"},
    {"MESH_PRIMITIVE_NO_TANGENT_SPACE", "tangents are made"},
    {"KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE", "the pointer says what moves"},
    {"NON_REQUIRED_EXTENSION", "quantised attributes are read without being asked for, too"},
    {"ACCESSOR_MIN_MISMATCH", "bounds are measured"},
    {"ACCESSOR_MAX_MISMATCH", "bounds are measured"},
    {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", "bounds are measured"},
    {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", "bounds are measured"},
    {"ACCESSOR_INVALID_FLOAT", "named at the node whose copies have them"},
    {"ACCESSOR_NORMALIZED_INVALID", "floats are read as they are"},
    {"ACCESSOR_VECTOR3_NON_UNIT", "made unit"},
    {"ACCESSOR_INVALID_SIGN", "of a tangent's fourth number the sign alone counts"},
    {"BUFFER_DATA_URI_MIME_TYPE_INVALID", "bytes are bytes"},
    {"GLB_UNEXPECTED_BIN_CHUNK", "the first BIN chunk is read, wherever it stands"},
    {"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT", "of an attribute that is not read"},
    {"MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY", "sets are found by their numbers"},
    {"NODE_SKIN_WITH_NON_SKINNED_MESH", "named at the mesh, which lacks the joints"},
    {"VALUE_MULTIPLE_OF", "a stride of any size is used: values are read byte by byte"},
    {"BUFFER_VIEW_INVALID_BYTE_STRIDE", "read by that stride, whatever uses the view"},
    {"BUFFER_VIEW_TOO_BIG_BYTE_STRIDE", "read by that stride, if the view is as long"},
    {"UNEXPECTED_EXTENSION_OBJECT", "an extension of other objects has no meaning there"},
};

/* Files, by the end of their path. */
static const struct {
    const char *file, *why;
} gn_validator_files[] = {
    {"animation/empty_objects.gltf", "an animation without channels moves nothing"},
    {"skin/unresolved_skeleton.gltf", "the skeleton's root is a hint, which is not read"},
    {"variant/empty_object.gltf", "no list of variants is none"},
    {"primitive/empties.gltf", "no list of mappings is none"},
    {"data/node/empty_object.gltf", "a node's extension that names no light has none"},
    {"light/empty_object.gltf", "no list of lights is none"},
    {"light/spot_light_without_spot_object.gltf", "a cone of 45 degrees, the extension's default"},
    {"json/bom.gltf", "a byte order mark before the text is skipped"},
    {"glb/bom.glb", "a byte order mark before the text is skipped"},
    {"asset/min_version_valid.gltf", "asks for a version after 2.0"},
};

enum {
    GN_VALIDATOR_CODES = sizeof gn_validator_codes / sizeof gn_validator_codes[0],
    GN_VALIDATOR_FILES = sizeof gn_validator_files / sizeof gn_validator_files[0]
};

#endif
