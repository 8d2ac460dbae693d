"""Pictures of beds: reflectance, light on a height field, photographs."""
