#include "unit/draco_help.h"

#include <stdio.h>

#include "unit/draco_bytes.h"

void gn_maker_draco(struct gn_maker *maker, bool required) {
    const int view = gn_maker_view(maker, gn_draco_square, sizeof gn_draco_square);
    char json[240];
    snprintf(
        json, sizeof json,
        "{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':2,'extensions':{"
        "'KHR_draco_mesh_compression':{'bufferView':%d,'attributes':{'POSITION':0,'NORMAL':1}}}}]}",
        view);
    gn_maker_add(maker, "meshes", json);
    gn_maker_set(maker, "accessors",
                 "[{'type':'VEC3','componentType':5126,'count':4,'min':[-1,0,-1],'max':[1,0,1]},"
                 "{'type':'VEC3','componentType':5126,'count':4},"
                 "{'type':'SCALAR','componentType':5123,'count':6}]");
    gn_maker_set(maker, "nodes", "[{'mesh':0}]");
    gn_maker_set(maker, "extensionsUsed", "['KHR_draco_mesh_compression']");
    if (required) gn_maker_set(maker, "extensionsRequired", "['KHR_draco_mesh_compression']");
}
